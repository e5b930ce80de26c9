// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct GizmoSettings;

/// Rows for the steps to which gizmos snap. Draws into the current menu.
void snapSteps(GizmoSettings& gizmo);

} // namespace limn
