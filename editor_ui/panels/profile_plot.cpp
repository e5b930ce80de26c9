// SPDX-License-Identifier: MIT
#include "editor_ui/panels/profile_plot.h"

#include "editor_ui/panels/theme.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <imgui.h>

namespace limn {

namespace {

/// Where the plot is on the screen [px].
struct Plot {
    ImVec2 centre;
    float radius = 0;

    /// The point of a relative intensity at a vertical angle [degrees]; side 1: right, -1: left.
    ImVec2 point(float vertical, float share, float side) const {
        const float angle = glm::radians(vertical);
        return {centre.x + side * share * radius * std::sin(angle),
                centre.y + share * radius * std::cos(angle)};
    }
};

constexpr float kStep = 2; ///< between points of a curve [degrees]

void drawGrid(ImDrawList& list, const Plot& plot, float peak) {
    const ImU32 ink = ImGui::GetColorU32(ImGuiCol_TextDisabled, 0.35f);
    for (int ring = 1; ring <= 4; ++ring)
        list.AddCircle(plot.centre, plot.radius * float(ring) / 4, ink, 64);
    for (int angle = 0; angle < 180; angle += 30)
        list.AddLine(plot.point(float(angle), 1, 1), plot.point(float(180 - angle), 1, -1), ink);
    const auto label = [&](ImVec2 place, const std::string& text, float left, float up) {
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        list.AddText({place.x - left * size.x, place.y - up * size.y}, color::dim(), text.c_str());
    };
    label(plot.point(0, 1, 1), "0\u00b0", 0.5f, 0);
    label(plot.point(90, 1, 1), " 90\u00b0", 0, 0.5f);
    label(plot.point(180, 1, 1), "180\u00b0", 0.5f, 1);
    label(plot.point(135, 1, -1), fmt::format("{:.4g} cd ", peak), 1, 0.8f);
}

/// The curve of two opposite half planes.
void drawCurve(ImDrawList& list, const Plot& plot, const LightProfile& profile, float horizontal,
               ImU32 ink, float width) {
    for (const float side : {1.f, -1.f}) {
        const float plane = side > 0 ? horizontal : horizontal + 180;
        ImVec2 before = plot.point(0, profileIntensity(profile, 1, 0, plane), side);
        for (float vertical = kStep; vertical <= 180; vertical += kStep) {
            const ImVec2 next =
                plot.point(vertical, profileIntensity(profile, 1, vertical, plane), side);
            list.AddLine(before, next, ink, width);
            before = next;
        }
    }
}

void hoverTooltip(const Plot& plot, const LightProfile& profile, float strength) {
    const ImVec2 mouse = ImGui::GetMousePos();
    const float x = mouse.x - plot.centre.x, y = mouse.y - plot.centre.y;
    const float vertical = glm::degrees(std::atan2(std::abs(x), y)), side = x < 0 ? 180.f : 0.f;
    ImGui::BeginTooltip();
    const auto line = [&](float horizontal) {
        ImGui::TextUnformatted(
            fmt::format("{:.0f}\u00b0 from the axis, {:.0f}\u00b0 around it: {:.4g} cd", vertical,
                        horizontal, profileIntensity(profile, strength, vertical, horizontal))
                .c_str());
    };
    line(side);
    if (profile.columns > 1)
        line(side + 90);
    ImGui::EndTooltip();
}

} // namespace

float profileIntensity(const LightProfile& profile, float strength, float vertical,
                       float horizontal) {
    // On the axis itself, a direction has no horizontal angle.
    const float v = glm::radians(std::clamp(vertical, 0.01f, 179.99f)),
                h = glm::radians(horizontal);
    return strength *
           profileShare(profile, glm::mat3(1),
                        {std::sin(v) * std::cos(h), std::sin(v) * std::sin(h), std::cos(v)});
}

void profilePlot(const Light& light) {
    const LightProfile* profile = profileOf(light);
    if (!profile)
        return;
    const float width = ImGui::GetContentRegionAvail().x, line = ImGui::GetTextLineHeight();
    const Plot plot{
        {ImGui::GetCursorScreenPos().x + width / 2, ImGui::GetCursorScreenPos().y + 7.5f * line},
        std::min(6 * line, std::max(width / 2 - 3 * line, line))};
    ImGui::InvisibleButton("profile", {std::max(width, 1.f), 15 * line});
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    drawGrid(list, plot, light.strength);
    const bool even = profile->columns == 1;
    if (!even)
        drawCurve(list, plot, *profile, 90, color::warning(), 1.5f * uiScale());
    drawCurve(list, plot, *profile, 0, color::accent(), 2.5f * uiScale());
    const auto legend = [](ImU32 ink, const char* text) {
        ImGui::PushStyleColor(ImGuiCol_Text, ink);
        ImGui::TextUnformatted(text);
        ImGui::PopStyleColor();
    };
    legend(color::accent(),
           even ? "The same all around the axis" : "Thick: 180\u00b0 | 0\u00b0 around the axis");
    if (!even)
        legend(color::warning(), "Thin: 270\u00b0 | 90\u00b0 around the axis");
    if (hovered)
        hoverTooltip(plot, *profile, light.strength);
}

} // namespace limn
