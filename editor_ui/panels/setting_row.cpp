// SPDX-License-Identifier: MIT
#include "editor_ui/panels/setting_row.h"

#include <imgui.h>

#include <string>

#include <glm/common.hpp>

namespace limn {

/// Ranges from 0 with an upper end above kWide, and others whose ends have a ratio above
/// kWideRatio, have a logarithmic slider.
static constexpr double kWide = 16, kWideRatio = 100;

/// "##rays": a widget without a label, by the setting's key.
static std::string idOf(const Setting& setting) {
    return std::string("##") + setting.key;
}

static ImGuiSliderFlags sliderFlags(const SettingRange& range) {
    const bool wide =
        range.lowest > 0 ? range.upper / range.lowest > kWideRatio : range.upper > kWide;
    return ImGuiSliderFlags_AlwaysClamp |
           (wide ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
}

void settingWidget(const Setting& setting, bool& value) {
    ImGui::Checkbox(idOf(setting).c_str(), &value);
}

void settingWidget(const Setting& setting, std::uint32_t& value, const SettingRange& range) {
    const auto lower = std::uint32_t(range.lowest), upper = std::uint32_t(range.upper);
    ImGui::SliderScalar(idOf(setting).c_str(), ImGuiDataType_U32, &value, &lower, &upper, "%u",
                        sliderFlags(range));
}

void settingWidget(const Setting& setting, float& value, const SettingRange& range) {
    ImGui::SliderFloat(idOf(setting).c_str(), &value, float(range.lower), float(range.upper),
                       "%.3f", sliderFlags(range));
}

void settingWidget(const Setting& setting, glm::uvec3& value, const SettingRange& range) {
    int cells[3] = {int(value.x), int(value.y), int(value.z)};
    if (!ImGui::DragInt3(idOf(setting).c_str(), cells, 0.1f, int(range.lower), int(range.upper),
                         "%d", ImGuiSliderFlags_AlwaysClamp))
        return;
    const glm::uvec3 wanted(cells[0], cells[1], cells[2]);
    const bool cleared = (wanted.x == 0 && value.x > 0) || (wanted.y == 0 && value.y > 0) ||
                         (wanted.z == 0 && value.z > 0);
    const bool any = wanted != glm::uvec3(0);
    value = cleared || !any ? glm::uvec3(0) : glm::max(wanted, glm::uvec3(1));
}

void settingWidget(const Setting& setting, int& value, const SettingChoices& choices) {
    ImGui::Combo(idOf(setting).c_str(), &value, choices.labels.data(), int(choices.labels.size()));
}

} // namespace limn
