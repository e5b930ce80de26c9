// SPDX-License-Identifier: MIT
#include "engine/scene/relight_settings.h"

#include "engine/scene/setting_text.h"

#include <fmt/format.h>

namespace limn {

std::string settingsDefect(const RelightSettings& s) {
    std::string defect;
    visitRelightSettings(s, [&](const Setting& setting, const auto& value, const auto&... limits) {
        const std::string wrong = valueDefect(value, limits...);
        if (defect.empty() && !wrong.empty())
            defect = fmt::format("relight settings: {} {}", setting.key, wrong);
    });
    return defect;
}

std::string setRelightSetting(RelightSettings& s, std::string_view key, const std::string& text) {
    std::string defect;
    visitRelightSettings(s, [&](const Setting& setting, auto& value, const auto&... limits) {
        if (setting.key == key)
            defect = readValue(text, value, limits...);
    });
    return defect;
}

} // namespace limn
