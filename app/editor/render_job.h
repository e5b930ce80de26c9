// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/jobs/relight_job.h"
#include "editor_ui/view/compare_state.h"
#include "engine/render/viewport.h"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace limn {

class RenderWorker;
struct DrawnImages;

/// What lights a picture.
struct LitBy {
    const Technique* technique = nullptr;    ///< null: nothing
    std::shared_ptr<const Precomputed> bake; ///< null where the technique precomputes nothing
    bool operator==(const LitBy&) const = default;
};

/// What a picture is to show. Equal pointers imply equal contents.
struct PictureRequest {
    std::shared_ptr<const Scene> scene;           ///< not null
    std::shared_ptr<const LightmapLayout> layout; ///< null: no bake
    std::shared_ptr<const IndirectField> field;   ///< null: no light, or `relight`
    ViewportOptions options;
    bool linear = false; ///< DrawnPicture::linear is wanted too
    bool meter = false;  ///< DrawnPicture::metered is wanted too
    bool moving = false; ///< shadow maps that change may be coarse
    bool gather = false; ///< at rest, where it can (RenderWorker::gathers())
    OverlayRequest overlay;
    std::shared_ptr<const OverlaySource> overlaySource; ///< null: no overlay
    std::shared_ptr<const Scene> overlayScene;          ///< scene that overlaySource was made from
    std::shared_ptr<const LightSnapshot> light;         ///< for overlays of light, unless `relight`
    const Technique* technique = nullptr; ///< whose bounced light is shown; null: there is none
    BakedScene lit;       ///< by the technique; null members where it precomputes nothing
    bool relight = false; ///< it is computed here, on the viewport's device, instead of `field`
    /// Trace scene of `scene`. If set, the time of relighting is first measured on either device;
    /// `lit` then belongs to `scene`, too.
    std::shared_ptr<const TraceScene> measure;

    LitBy litBy() const { return {technique, lit.bake}; }
};

struct DrawnPicture {
    std::shared_ptr<const Image> image;          ///< tone-mapped; null: none yet
    std::uint64_t number = 0;                    ///< of this picture, counted from 1
    std::shared_ptr<const LinearPicture> linear; ///< null: not asked for
    std::optional<float> metered; ///< meteredExposure() of it; empty: not asked for, or black
    OverlayLegend legend;         ///< of its overlay
    ViewportStats stats;
    bool nearLight = false;                        ///< RenderWorker::showsNearLight()
    bool gathers = false;                          ///< RenderWorker::gathers()
    float gathered = 0;                            ///< RenderWorker::gathered()
    bool running = false;                          ///< another one is being drawn
    LitBy lit;                                     ///< what the following members are about
    LightingStatus relight;                        ///< by this device
    std::shared_ptr<const LightSnapshot> snapshot; ///< as RenderWorker::snapshot
    std::shared_ptr<const Scene> snapshotScene;
    std::string refusal;               ///< why the device cannot light it; empty: it can
    std::optional<RelightTimes> times; ///< of what is like it, measured now or before
    std::string error;                 ///< why there will be no more pictures
};

/// Draws the viewport on a thread and a Vulkan device of its own, so that neither a large upload
/// nor a slow picture holds up the window: on a software rasteriser everything on one queue would
/// wait for it. The picture comes back through the CPU. If it relights, it redraws after every few
/// bounces until they have converged. Then it refines a picture that stands still, gathers its
/// light, and sleeps.
class RenderJob {
public:
    /// `wake` is called from the thread when there is a new result().
    RenderJob(bool validate, std::function<void()> wake);
    ~RenderJob();
    RenderJob(const RenderJob&) = delete;
    RenderJob& operator=(const RenderJob&) = delete;

    /// Requests a picture. Earlier requests that were not started are dropped.
    void draw(PictureRequest request);

    DrawnPicture result() const;
    std::vector<std::string> validationMessages() const;

private:
    void run(bool validate);
    void publish(RenderWorker& worker, DrawnImages images);
    void publishRefined(const RenderWorker& worker, DrawnImages images);

    std::function<void()> m_wake;
    std::atomic<bool> m_hurry{false}; ///< another picture is requested, or the job is stopping
    mutable std::mutex m_mutex;       ///< guards the members below
    std::condition_variable m_changed;
    std::optional<PictureRequest> m_next;
    std::shared_ptr<const Scene> m_lastScene; ///< of the latest request
    DrawnPicture m_result;
    std::vector<std::string> m_messages;
    bool m_stop = false;
    std::thread m_thread; ///< declared last, so that it starts after all other members exist
};

} // namespace limn
