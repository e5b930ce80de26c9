// SPDX-License-Identifier: MIT
#pragma once

#include "app/ui_renderer.h"
#include "editor_ui/session.h"
#include "engine/render/viewport.h"

#include <chrono>
#include <optional>

namespace limn {

/// Draws the session's scene into the viewport when, and only when, something it shows has changed;
/// with fewer pixels while things move, where the device is too slow for all of them.
class ViewportPicture {
public:
    explicit ViewportPicture(gpu::Device& device) : m_viewport(device) {}

    /// Submits a new picture if one is due, and fills state.frame.
    void update(Session& session);

    /// What the window shows; its image is null before the first update().
    WindowPicture picture(const ViewState& view) const;

    /// Seconds until update() should be called again although nothing happens; < 0: never.
    double secondsToNext() const;

    Viewport& viewport() { return m_viewport; }

private:
    struct Shown {
        View view = View::Lit;
        Tonemap tonemap = Tonemap::Aces;
        float exposureEv = 0;
        Camera camera;
        glm::uvec2 size{0};

        bool operator==(const Shown&) const = default;
    };

    bool uploadChanges(const Session& session);
    float chooseScale(glm::uvec2 full, bool moving) const;

    Viewport m_viewport;
    std::shared_ptr<const Scene> m_scene;
    std::shared_ptr<const LightmapLayout> m_layout;
    std::shared_ptr<const IndirectField> m_field;
    std::optional<Shown> m_shown;
    glm::uvec2 m_size{0}; ///< of the picture drawn last
    std::chrono::steady_clock::time_point m_changed;
    double m_msPerPixel = 0; ///< of recent pictures; 0: none yet
    bool m_reduced = false;  ///< the picture has fewer pixels than the window has for it
};

} // namespace limn
