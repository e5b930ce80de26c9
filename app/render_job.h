// SPDX-License-Identifier: MIT
#pragma once

#include "engine/overlay/overlay.h"
#include "engine/render/viewport.h"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace limn {

/// What a picture is to show. Pointers stand for their contents.
struct PictureRequest {
    std::shared_ptr<const Scene> scene;           ///< not null
    std::shared_ptr<const LightmapLayout> layout; ///< null: no bake
    std::shared_ptr<const IndirectField> field;   ///< null: no bake
    ViewportOptions options;
    OverlayOptions overlay;
    std::shared_ptr<const Bake> bake;        ///< that the overlay shows; null: there is no overlay
    std::shared_ptr<const Scene> bakedScene; ///< that `bake` was made from
};

struct DrawnPicture {
    std::shared_ptr<const Image> image; ///< tone-mapped; null: none yet
    std::uint64_t number = 0;           ///< of this picture, from 1
    OverlayLegend legend;               ///< of its overlay
    ViewportStats stats;
    bool running = false; ///< another one is being drawn
    std::string error;    ///< why there will be no more pictures
};

/// Draws the viewport on a thread and a Vulkan device of its own, so that neither a large upload
/// nor a slow picture holds up the window: on a software rasteriser everything on one queue would
/// wait for it. The picture comes back through the CPU.
class RenderJob {
public:
    /// `wake` is called from the thread when there is a new result().
    RenderJob(bool validate, std::function<void()> wake);
    ~RenderJob();
    RenderJob(const RenderJob&) = delete;
    RenderJob& operator=(const RenderJob&) = delete;

    /// The newest picture wanted; those it had no time for are dropped.
    void draw(PictureRequest request);

    DrawnPicture result() const;
    std::vector<std::string> validationMessages() const;

private:
    struct Worker;
    void run(bool validate);
    void publish(Worker& worker, std::shared_ptr<const Image> image);

    std::function<void()> m_wake;
    mutable std::mutex m_mutex; ///< of what follows
    std::condition_variable m_changed;
    std::optional<PictureRequest> m_next;
    DrawnPicture m_result;
    std::vector<std::string> m_messages;
    bool m_stop = false;
    std::thread m_thread; ///< last: starts when everything else is there
};

} // namespace limn
