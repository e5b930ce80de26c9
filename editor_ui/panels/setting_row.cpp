// SPDX-License-Identifier: MIT
#include "editor_ui/panels/setting_row.h"

#include <imgui.h>

#include <algorithm>

#include <glm/common.hpp>

namespace limn {

/// Ranges wider than this have a slider of equal ratios, not of equal steps.
static constexpr double kWide = 16;

namespace {

/// The label of a row and, when it goes, what follows its widget.
struct Row {
    FieldEdit& edit;
    const Setting& setting;

    Row(FieldEdit& e, const Setting& s) : edit(e), setting(s) {
        fieldLabel(s.label, s.tooltip);
        ImGui::PushID(s.key);
    }
    ~Row() {
        ImGui::PopID();
        fieldEdited(edit, setting.label);
    }
    Row(const Row&) = delete;
    Row& operator=(const Row&) = delete;
};

} // namespace

static ImGuiSliderFlags sliderFlags(const SettingRange& range) {
    return ImGuiSliderFlags_AlwaysClamp |
           (range.upper > kWide ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
}

void settingRow(FieldEdit& edit, const Setting& setting, bool& value) {
    const Row row(edit, setting);
    ImGui::Checkbox("##value", &value);
}

void settingRow(FieldEdit& edit, const Setting& setting, std::uint32_t& value,
                const SettingRange& range) {
    const Row row(edit, setting);
    const auto lower = std::uint32_t(range.lowest), upper = std::uint32_t(range.upper);
    ImGui::SliderScalar("##value", ImGuiDataType_U32, &value, &lower, &upper, "%u",
                        sliderFlags(range));
}

void settingRow(FieldEdit& edit, const Setting& setting, float& value, const SettingRange& range) {
    const Row row(edit, setting);
    ImGui::SliderFloat("##value", &value, float(range.lower), float(range.upper), "%.3f",
                       sliderFlags(range));
}

void settingRow(FieldEdit& edit, const Setting& setting, glm::uvec3& value,
                const SettingRange& range) {
    const Row row(edit, setting);
    int cells[3] = {int(value.x), int(value.y), int(value.z)};
    if (!ImGui::DragInt3("##value", cells, 0.1f, int(range.lower), int(range.upper), "%d",
                         ImGuiSliderFlags_AlwaysClamp))
        return;
    const glm::uvec3 wanted(cells[0], cells[1], cells[2]);
    const bool cleared = (wanted.x == 0 && value.x > 0) || (wanted.y == 0 && value.y > 0) ||
                         (wanted.z == 0 && value.z > 0);
    const bool any = wanted != glm::uvec3(0);
    value = cleared || !any ? glm::uvec3(0) : glm::max(wanted, glm::uvec3(1));
}

void choiceRow(FieldEdit& edit, const Setting& setting, int& value, const SettingChoices& choices) {
    const Row row(edit, setting);
    ImGui::Combo("##value", &value, choices.labels.data(), int(choices.labels.size()));
}

} // namespace limn
