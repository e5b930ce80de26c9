// SPDX-License-Identifier: MIT
#include "editor_ui/panels/exposure_field.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/field.h"

#include <imgui.h>

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace limn {

std::string shutterText(float seconds) {
    return seconds < 0.4f ? fmt::format("1/{:.{}f} s", 1 / seconds, seconds > 0.1f ? 1 : 0)
                          : fmt::format("{:.{}f} s", seconds, seconds < 10 ? 1 : 0);
}

/// Sets the exposure by hand.
static void expose(ViewState& view, float ev) {
    view.exposureEv = std::clamp(ev, -kMaxExposureEv, kMaxExposureEv);
    view.autoExposure = false;
}

static bool drag(const char* label, float& value, float speed, float lower, float upper,
                 const char* format, const char* tooltip, int flags = 0) {
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 7);
    const bool changed = ImGui::DragFloat(label, &value, speed, lower, upper, format,
                                          ImGuiSliderFlags_AlwaysClamp | flags);
    wrappedTooltip(tooltip);
    return changed;
}

static void cameraFields(ViewState& view) {
    float ev100 = ev100Of(view.exposureEv);
    if (drag("EV100", ev100, 0.02f, ev100Of(kMaxExposureEv), ev100Of(-kMaxExposureEv), "%.2f",
             "The same exposure as photographers count it: higher is darker. Full sun needs 15, a "
             "lit room 6 [EV at ISO 100]. Double-click to type"))
        expose(view, exposureOfEv100(ev100));
    ImGui::Separator();
    ImGui::TextDisabled("As a camera's");
    CameraExposure& camera = view.physical;
    float seconds = shutterOf(camera, view.exposureEv);
    const float slowest = shutterOf(camera, kMaxExposureEv);
    const float fastest = shutterOf(camera, -kMaxExposureEv);
    if (drag("Shutter", seconds, 0.01f * seconds, fastest, slowest, shutterText(seconds).c_str(),
             "Time for which light falls onto the film [s]. Twice the time is one EV more. "
             "Double-click to type"))
        expose(view, exposureOfShutter(camera, seconds));
    // While exposure is automatic, the shutter time follows the other two.
    seconds = shutterOf(camera, view.exposureEv);
    bool changed = drag("Aperture", camera.aperture, 0.05f, kMinAperture, kMaxAperture, "f/%.1f",
                        "Focal length over the opening's diameter. A larger number is darker. "
                        "Nothing blurs. Double-click to type",
                        ImGuiSliderFlags_Logarithmic);
    changed |= drag("ISO", camera.iso, 10, kMinIso, kMaxIso, "%.0f",
                    "Sensitivity of the film. Twice the number is one EV more. Double-click to "
                    "type",
                    ImGuiSliderFlags_Logarithmic);
    if (changed && !view.autoExposure)
        expose(view, exposureOfShutter(camera, seconds));
}

static void tonemapCombo(ViewState& view) {
    static constexpr const char* kNames[] = {"None", "ACES fitted", "AgX", "Khronos PBR Neutral"};
    static_assert(std::size(kNames) == kTonemapNames.size());
    int tonemap = int(view.tonemap);
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 12);
    if (ImGui::Combo("Tone mapping", &tonemap, kNames, int(std::size(kNames))))
        view.tonemap = Tonemap(tonemap);
    wrappedTooltip("How scene light becomes display colours");
}

void exposureField(ViewState& view, float width) {
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::SetNextItemWidth(width - gap - ImGui::GetFrameHeight());
    float ev = view.exposureEv;
    if (ImGui::DragFloat("##exposure", &ev, 0.02f, -kMaxExposureEv, kMaxExposureEv,
                         view.autoExposure ? "auto %+.1f" : "%+.2f EV",
                         ImGuiSliderFlags_AlwaysClamp))
        expose(view, ev);
    wrappedTooltip("Exposure: light is multiplied by 2 to this power before tone mapping. Drag, or "
                   "double-click to type");
    ImGui::SameLine(0, gap);
    if (ImGui::ArrowButton("##exposure more", ImGuiDir_Down))
        ImGui::OpenPopup("exposure");
    wrappedTooltip("Tone mapping, automatic exposure, EV100 and camera settings");
    if (!ImGui::BeginPopup("exposure"))
        return;
    tonemapCombo(view);
    ImGui::Separator();
    ImGui::Checkbox("Automatic", &view.autoExposure);
    wrappedTooltip("The exposure follows the picture: most of it is middle grey. Exports and saved "
                   "pictures do not depend on it");
    cameraFields(view);
    ImGui::EndPopup();
}

} // namespace limn
