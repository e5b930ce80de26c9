// SPDX-License-Identifier: MIT
#include "engine/scene/bake_settings.h"

#include "engine/scene/bake_settings_fields.h"
#include "engine/scene/setting_text.h"

#include <fmt/format.h>

namespace limn {

std::string settingsDefect(const BakeSettings& s) {
    std::string defect;
    visitBakeSettings(s, [&](const Setting& setting, const auto& value, const auto&... limits) {
        if (defect.empty())
            if (const std::string wrong = valueDefect(value, limits...); !wrong.empty())
                defect = fmt::format("bake settings: {} {}", setting.key, wrong);
    });
    if (!defect.empty())
        return defect;
    if (s.texelsPerMetre == 0 && s.lightmapCaches == 0)
        return "bake settings: neither lightmapCaches nor texelsPerMetre is more than 0";
    if (s.grid != glm::uvec3(0) && (s.grid.x == 0 || s.grid.y == 0 || s.grid.z == 0))
        return fmt::format("bake settings: grid {}x{}x{} has no cells along one side", s.grid.x,
                           s.grid.y, s.grid.z);
    return {};
}

std::string setBakeSetting(BakeSettings& s, std::string_view key, const std::string& text) {
    return setByKey([&](const auto& visit) { visitBakeSettings(s, visit); }, key, text);
}

} // namespace limn
