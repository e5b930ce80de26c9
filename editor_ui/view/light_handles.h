// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/view/gizmo_drag.h"

#include <vector>

namespace limn {

/// A dot in the picture by which a part of a light is dragged.
struct LightGrip {
    LightPart part = LightPart::None;
    glm::vec3 position{0}; ///< in world space [m]
};

/// The grips of a light: direction of all but points, both cones of a spot, width and height of a
/// rectangle, a limited range.
std::vector<LightGrip> lightGrips(const Picture& picture, const Light& light);

/// The part whose grip is within 8 pixels of the mouse.
LightPart lightPartAt(const Picture& picture, const Light& light, glm::vec2 mouse);

/// `light` after its part was dragged from `start` to `now` [px]. Its direction goes to `aim` [m],
/// or, without one, to what is under the mouse at the light's own depth. std::nullopt while the
/// drag has no meaning, as when a ray misses.
std::optional<Light> draggedLight(const Picture& picture, const Light& light, LightPart part,
                                  glm::vec2 start, glm::vec2 now, std::optional<glm::vec3> aim);

/// Draws the grips, the cones and the line to each into the current window.
void drawLightHandles(const Picture& picture, const Light& light, LightPart lit);

/// What an edit of the part is called, as in the inspector: "Light cone".
const char* lightPartLabel(LightPart part);

/// The part's value with its unit: "Cone 45.0°".
std::string lightPartText(const Light& light, LightPart part);

} // namespace limn
