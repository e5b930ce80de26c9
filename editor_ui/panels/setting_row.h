// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/panels/field.h"
#include "engine/scene/setting.h"

#include <cstdint>
#include <type_traits>

#include <glm/vec3.hpp>

namespace limn {

// The inspector's row for a setting: its label, tooltip and a widget that keeps to its limits. The
// last of them is for any enumeration.

void settingRow(FieldEdit& edit, const Setting& setting, bool& value);
void settingRow(FieldEdit& edit, const Setting& setting, std::uint32_t& value,
                const SettingRange& range);
void settingRow(FieldEdit& edit, const Setting& setting, float& value, const SettingRange& range);
/// Cells along three sides; all of them are 0, or none.
void settingRow(FieldEdit& edit, const Setting& setting, glm::uvec3& value,
                const SettingRange& range);
void choiceRow(FieldEdit& edit, const Setting& setting, int& value, const SettingChoices& choices);
template <class T>
requires std::is_enum_v<T>
void settingRow(FieldEdit& edit, const Setting& setting, T& value, const SettingChoices& choices) {
    int index = int(value);
    choiceRow(edit, setting, index, choices);
    value = T(index);
}

} // namespace limn
