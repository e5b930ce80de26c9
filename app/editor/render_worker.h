// SPDX-License-Identifier: MIT
#pragma once

#include "app/editor/render_job.h"
#include "engine/gpu/device.h"
#include "engine/techniques/illuminance/gpu/viewport_relighter.h"
#include "engine/techniques/illuminance/relight/seen_caches.h"

namespace limn {

/// What RenderJob's thread draws with; nobody else touches it.
class RenderWorker {
public:
    /// Throws where there is no device.
    explicit RenderWorker(bool validate);

    /// `hurry`: another picture is wanted, so that bounces can wait.
    Image draw(PictureRequest request, const std::atomic<bool>& hurry);

    /// Light is still bouncing, or not lit where the picture does not show it: the picture shown is
    /// to be drawn again.
    bool bouncing() const {
        return shown.relight && m_relighter && !(relight.converged && m_whole);
    }

    std::unique_ptr<gpu::Device> device;
    Viewport viewport;
    PictureRequest shown;
    std::shared_ptr<const OverlayData> overlay; ///< of `shown`; null: none
    RelightStatus relight;                      ///< by the device
    std::string refusal;                        ///< why it cannot light shown.lit; empty: it can
    std::optional<RelightTimes> times;          ///< of bakes like shown.lit

private:
    void takeBake(const PictureRequest& request);
    void takeScene(const PictureRequest& request);
    void makeRelighter(const PictureRequest& request);
    void measure(const PictureRequest& request);
    void takeField(const PictureRequest& request);
    void bounce(const PictureRequest& request, const std::atomic<bool>& hurry);
    const CacheFlags* seenBy(const PictureRequest& request);
    void makeOverlay(const PictureRequest& request);

    std::unique_ptr<ViewportRelighter> m_relighter; ///< of shown.lit, while it is needed
    bool m_litMoving = false;                       ///< by shadow maps that may be coarse
    bool m_ownField = false;                        ///< the viewport shows the relighter's
    std::shared_ptr<const Scene> m_litOf;           ///< that `m_litScene` was made of
    std::shared_ptr<const Scene> m_litScene;        ///< as the bake can be lit with
    std::string m_timesKey;                         ///< of shown.lit
    SeenFrom m_seen;                                ///< of shown.lit
    bool m_whole = false;                           ///< the field has the newest light everywhere
    bool m_everWhole = false;                       ///< it had some of shown.lit's
    double m_pictureMs = 0;                         ///< what the last picture took, without bounces
};

} // namespace limn
