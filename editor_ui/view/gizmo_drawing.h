// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/view/gizmo_math.h"

#include <string>

namespace limn {

/// Draws a gizmo into the current window. Axes have their letter as well as their colour; `lit` is
/// highlighted.
void drawGizmo(const Picture& picture, Tool tool, const GizmoFrame& frame, Handle lit);

/// Draws text on a dark ground beside a pixel, within the current window.
void drawReadout(glm::vec2 pixel, const std::string& text);

} // namespace limn
