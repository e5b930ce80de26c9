// SPDX-License-Identifier: MIT
#pragma once

#include "app/editor/render_job.h"
#include "app/editor/ui_renderer.h"
#include "editor_ui/session.h"
#include "engine/gpu/image.h"

#include <chrono>
#include <optional>

namespace limn {

/// Asks for a picture of the session's scene when, and only when, something it shows has changed;
/// with fewer pixels while things move, where the device is too slow for all of them.
class ViewportPicture {
public:
    ViewportPicture(gpu::Device& windowDevice, bool validate, std::function<void()> wake)
        : m_device(windowDevice), m_job(validate, std::move(wake)) {}

    /// Asks for a new picture if one is due, takes in the last one drawn, and fills state.frame.
    void update(Session& session);

    /// Records what brings the newest picture to the window's device; returns what the window
    /// shows.
    WindowPicture record(VkCommandBuffer cmd, const ViewState& view);

    /// Seconds until update() should be called again although nothing happens; < 0: never.
    double secondsToNext() const;

    /// No picture is due or being drawn.
    bool idle() const { return !m_drawn.running && secondsToNext() < 0; }

    std::shared_ptr<const Image> image() const { return m_drawn.image; }
    std::vector<std::string> validationMessages() const { return m_job.validationMessages(); }

private:
    struct Shown {
        View view = View::Lit;
        Tonemap tonemap = Tonemap::Aces;
        float exposureEv = 0;
        Camera camera;
        glm::uvec2 size{0};
        std::shared_ptr<const Scene> scene;
        std::shared_ptr<const LightmapLayout> layout;
        std::shared_ptr<const IndirectField> field;
        OverlayOptions overlay;
        std::shared_ptr<const Bake> bake; ///< of the overlay; null: there is none
        std::shared_ptr<const LitBake> light;
        std::shared_ptr<const Bake> lit; ///< whose light is shown
        bool relight = false;            ///< by the viewport's device

        bool operator==(const Shown&) const = default;
    };

    float chooseScale(glm::uvec2 full) const;
    void takeDrawn(Session& session);
    void takeRelit(Session& session);
    bool measureNow(const Session& session);

    gpu::Device& m_device;
    RenderJob m_job;
    DrawnPicture m_drawn;
    gpu::Image m_image;           ///< on the window's device
    std::uint64_t m_onDevice = 0; ///< number of the picture in m_image
    std::optional<Shown> m_shown; ///< as asked for last
    std::chrono::steady_clock::time_point m_changed;
    /// Of the last picture: of its shadow maps, which do not depend on its size, and of the rest.
    double m_shadowMs = 0, m_msPerPixel = 0; ///< 0: none yet
    std::shared_ptr<const Bake> m_measured;  ///< that relighting was measured for last
    bool m_reduced = false; ///< the picture asked for has fewer pixels than the window has for it
};

} // namespace limn
