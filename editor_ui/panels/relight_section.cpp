// SPDX-License-Identifier: MIT
#include "editor_ui/panels/inspector_panel.h"
#include "editor_ui/panels/setting_row.h"

namespace limn {

void relightSection(FieldEdit& edit, RelightSettings& settings) {
    visitRelightSettings(settings, [&](const Setting& setting, auto& value, const auto&... limits) {
        settingRow(edit, setting, value, limits...);
    });
}

} // namespace limn
