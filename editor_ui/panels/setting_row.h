// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/panels/field.h"
#include "engine/scene/setting.h"

#include <cstdint>
#include <type_traits>

#include <glm/vec3.hpp>

namespace limn {

// Widgets that edit a setting within its limits. The last overload is for any enumeration.

void settingWidget(const Setting& setting, bool& value);
void settingWidget(const Setting& setting, std::uint32_t& value, const SettingRange& range);
void settingWidget(const Setting& setting, float& value, const SettingRange& range);
/// Numbers of cells along the three axes; either all of them are 0 or none.
void settingWidget(const Setting& setting, glm::uvec3& value, const SettingRange& range);
void settingWidget(const Setting& setting, int& value, const SettingChoices& choices);
template <class T>
requires std::is_enum_v<T>
void settingWidget(const Setting& setting, T& value, const SettingChoices& choices) {
    int index = int(value);
    settingWidget(setting, index, choices);
    value = T(index);
}

/// The inspector's row for a setting of the object that is edited: label, tooltip and widget.
template <class T, class... Limits>
void settingRow(FieldEdit& edit, const Setting& setting, T& value, const Limits&... limits) {
    fieldLabel(setting.label, setting.tooltip);
    settingWidget(setting, value, limits...);
    fieldEdited(edit, setting.label);
}

} // namespace limn
