// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/field_rule.h"
#include "engine/scene/bake_settings_fields.h"
#include "engine/scene/setting_text.h"

namespace limn {

/// Lists the fields of bake settings, each within its range.
template <class A, class S>
void bakeSettingsFields(A& a, S& settings) {
    visitBakeSettings(settings, [&](const Setting& setting, auto& value, const auto&... limits) {
        a(setting.key, value, rule::holds("out of range", [&](const auto& v) {
              return valueDefect(v, limits...).empty();
          }));
    });
}

} // namespace limn
