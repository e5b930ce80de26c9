// SPDX-License-Identifier: MIT
#include "editor_ui/panels/snap_steps.h"

#include "editor_ui/panels/field.h"
#include "editor_ui/view/gizmo_drag.h"

#include <imgui.h>

namespace limn {

static void stepRow(const char* label, const char* tooltip, float& step, float lower, float upper,
                    const char* format) {
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 7);
    ImGui::DragFloat(label, &step, 0.01f * upper, lower, upper, format,
                     ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
    wrappedTooltip(tooltip);
}

void snapSteps(GizmoSettings& gizmo) {
    stepRow("Step of Move (m)",
            "Ctrl while dragging snaps to multiples of this; 0: a round step that fits the view "
            "[m]. Double-click to type",
            gizmo.moveStep, 0, kMaxMoveStep, gizmo.moveStep > 0 ? "%.3f m" : "fits the view");
    stepRow("Step of Rotate (\u00b0)",
            "Ctrl while dragging snaps to multiples of this [degrees]. Double-click to type",
            gizmo.rotateStep, kMinRotateStep, kMaxRotateStep, "%.1f\u00b0");
    stepRow("Step of Scale",
            "Ctrl while dragging snaps to multiples of this factor. Double-click to type",
            gizmo.scaleStep, kMinScaleStep, kMaxScaleStep, "%.3f");
}

} // namespace limn
