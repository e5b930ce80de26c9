// SPDX-License-Identifier: MIT
#pragma once

#include "app/editor/render_job.h"
#include "app/editor/rest_gather.h"
#include "engine/gpu/device.h"
#include "engine/lighting/lighting_driver.h"
#include "engine/render/viewport.h"

namespace limn {

/// Images of one picture.
struct DrawnImages {
    std::shared_ptr<const Image> shown;          ///< tone-mapped
    std::shared_ptr<const LinearPicture> linear; ///< null unless PictureRequest::linear
    std::optional<float> metered;                ///< empty unless PictureRequest::meter
};

/// Whether a picture that stands still is refined from `samples` samples of each pixel to twice as
/// many, given the time of one [ms]. It is not where that would take longer than kMaxRefineMs.
bool worthRefining(std::uint32_t samples, double sampleMs);
constexpr double kMaxRefineMs = 20'000;

/// What RenderJob's thread draws with. No other thread uses it.
class RenderWorker {
public:
    /// Throws if there is no device.
    explicit RenderWorker(bool validate);

    /// Draws a picture. `hurry` is set if another picture is requested; bounces then wait.
    DrawnImages draw(PictureRequest request, const std::atomic<bool>& hurry);

    /// True if the light is still bouncing or not all caches are lit, so that the picture shown
    /// must be redrawn.
    bool bouncing() const { return shown.relight && m_driver.lighting() && !m_driver.done(); }

    /// True if the picture shown stands still and is not yet the mean of as many samples of each
    /// pixel as it will be (worthRefining()). Pictures with an overlay or an inspection are not
    /// refined, because what is drawn over them would jitter.
    bool refining() const;

    /// Whether refined pictures have light from near surfaces (ViewportOptions::nearRays): on all
    /// devices but software rasterisers, on which a picture would hold up the next for seconds.
    bool showsNearLight() const { return !device->softwareRasteriser; }

    /// Doubles the samples of the picture shown. Empty if `hurry` was set before that was done.
    /// Precondition: refining().
    std::optional<DrawnImages> refine(const std::atomic<bool>& hurry);

    /// Whether the picture shown ends with final gathering once it stands still. That is on the
    /// CPU, from the light of a bake that holds for all surfaces that stand still.
    bool gathers() const { return m_gathers; }
    /// Share of the picture that is gathered.
    float gathered() const { return m_gather ? m_gather->share() : 0; }
    /// True if there is something left to gather, and nothing to do before.
    bool gathering() const {
        return m_gathers && !bouncing() && !refining() && !(m_gather && m_gather->done());
    }
    /// Gathers some of the picture shown. Empty if there is nothing to show, or if `hurry` was set
    /// before that was done; then the next call must be draw(). Precondition: gathering().
    std::optional<DrawnImages> gather(const std::atomic<bool>& hurry);

    std::unique_ptr<gpu::Device> device;
    Viewport viewport;
    PictureRequest shown;
    std::shared_ptr<const OverlayData> overlay; ///< of `shown`; null: none
    LightingStatus relight;                     ///< by the device
    /// The device's light, for an overlay that is made of it, and the scene that it lights; null:
    /// there is no such overlay.
    std::shared_ptr<const LightSnapshot> snapshot;
    std::shared_ptr<const Scene> snapshotScene;
    std::string refusal;               ///< why it cannot light by shown.litBy(); empty: it can
    std::optional<RelightTimes> times; ///< of what is like shown.litBy()

private:
    void takeLitBy(const PictureRequest& request);
    void takeScene(const PictureRequest& request);
    void dropLighting();
    void makeLighting(const PictureRequest& request);
    void measure(const PictureRequest& request);
    void takeField(const PictureRequest& request);
    void bounce(const PictureRequest& request, const std::atomic<bool>& hurry);
    void takeSnapshot(const PictureRequest& request);
    void makeOverlay(const PictureRequest& request);
    DrawnImages readImages();
    bool beginGathering(const std::atomic<bool>& hurry);
    bool takeGatheredFrom();

    LightingDriver m_driver;                 ///< of shown.litBy(), while it is needed
    bool m_litMoving = false;                ///< lit by shadow maps that may be coarse
    bool m_ownField = false;                 ///< the viewport shows the relighter's field
    std::shared_ptr<const Scene> m_litOf;    ///< scene from which `m_litScene` was made
    std::shared_ptr<const Scene> m_litScene; ///< scene with which the bake, if any, can be lit
    std::uint64_t m_snapshotCalls = 0;       ///< `relight.calls` at the last snapshot
    std::string m_timesKey;                  ///< of shown.litBy()
    std::uint32_t m_samples = 0;             ///< of each pixel of the picture shown
    double m_pictureMs = 0;                  ///< what the last picture took, without bounces
    bool m_gathers = false;                  ///< gathers()
    GatheredFrom m_from;                     ///< for m_fromScene, lit from m_fromBake
    std::shared_ptr<const Scene> m_fromScene;
    std::shared_ptr<const Precomputed> m_fromBake;
    std::unique_ptr<RestGather> m_gather; ///< of the picture shown; null: it has not begun
};

} // namespace limn
