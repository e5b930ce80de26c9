// SPDX-License-Identifier: MIT
#pragma once

#include "app/editor/render_job.h"
#include "app/editor/ui_renderer.h"
#include "editor_ui/session.h"
#include "engine/gpu/image.h"

#include <chrono>
#include <optional>

namespace limn {

/// Requests a picture of the session's scene if, and only if, something that it shows has changed.
/// While things move, the picture has fewer pixels if the device is too slow for full resolution.
class ViewportPicture {
public:
    ViewportPicture(gpu::Device& windowDevice, bool validate, std::function<void()> wake)
        : m_device(windowDevice), m_validate(validate), m_wake(wake),
          m_job(validate, std::move(wake)) {}

    /// Requests a new picture if one is due, takes in the last one drawn, and fills state.frame.
    void update(Session& session);

    /// Records the upload of the newest picture to the window's device; returns what the window
    /// shows.
    WindowPicture record(VkCommandBuffer cmd, const ViewState& view);

    /// Seconds until update() should be called again even if nothing happens; < 0: never.
    double secondsToNext() const;

    /// True if no picture is due or being drawn.
    bool idle() const {
        return !m_drawn.running && secondsToNext() < 0 && !(m_otherJob && m_other.running);
    }

    std::shared_ptr<const Image> image() const { return m_drawn.image; }
    std::vector<std::string> validationMessages() const;

private:
    struct Shown {
        View view = View::Lit;
        Inspection inspection = Inspection::None;
        Tonemap tonemap = Tonemap::Aces;
        float exposureEv = 0;
        bool autoExposure = false;
        Camera camera;
        glm::uvec2 size{0};
        std::shared_ptr<const Scene> scene;
        std::shared_ptr<const LightmapLayout> layout;
        std::shared_ptr<const IndirectField> field;
        OverlayRequest overlay;
        std::shared_ptr<const OverlaySource> overlaySource; ///< null: there is none
        std::shared_ptr<const LightSnapshot> light;
        LitBy lit;
        bool relight = false; ///< by the viewport's device
        bool linear = false;  ///< it is compared with the reference
        bool gather = false;  ///< not beside another technique, whose picture is not gathered

        bool operator==(const Shown&) const = default;
    };

    Image withCompared(const Image& image, std::uint32_t column) const;
    float chooseScale(glm::uvec2 full) const;
    void takeDrawn(Session& session);
    void takeRelit(Session& session);
    bool measureNow(const Session& session);
    void updateOther(Session& session);

    gpu::Device& m_device;
    bool m_validate;
    std::function<void()> m_wake;
    RenderJob m_job;
    DrawnPicture m_drawn;
    ViewportOptions m_options; ///< of the last request
    /// Draws the scene as another technique lights it; null: not wanted.
    std::unique_ptr<RenderJob> m_otherJob;
    ShownScene m_otherLit;          ///< of its last request
    ViewportOptions m_otherOptions; ///< of its last request
    DrawnPicture m_other;
    gpu::Image m_image; ///< on the window's device
    /// What m_image holds: numbers of the picture and of what it is compared with (0: nothing), and
    /// the column at which the latter begins.
    struct OnDevice {
        std::uint64_t picture = 0, compared = 0;
        std::uint32_t column = 0;
        bool operator==(const OnDevice&) const = default;
    } m_onDevice;
    ComparedPicture m_compared;   ///< stands beside the picture; null image: nothing does
    float m_split = 1;            ///< where it begins, as a fraction of the width
    std::optional<Shown> m_shown; ///< the latest request
    std::chrono::steady_clock::time_point m_changed;
    /// Times of the last picture: of its shadow maps, which do not depend on its size, and of the
    /// rest.
    double m_shadowMs = 0, m_msPerPixel = 0; ///< 0: none yet
    LitBy m_measured;                        ///< for which relighting was measured last
    bool m_reduced = false; ///< the picture asked for has fewer pixels than the window has for it
};

} // namespace limn
