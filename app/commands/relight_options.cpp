// SPDX-License-Identifier: MIT
#include "app/commands/relight_options.h"

namespace limn {

void addRelightOptions(Command& command, GivenSettings& given) {
    const RelightSettings defaults;
    visitRelightSettings(defaults, [&](const Setting& setting, const auto&, const auto&... limits) {
        addSettingOption(
            command, given, setting,
            [](const std::string& key, const std::string& text) {
                RelightSettings scratch;
                return setRelightSetting(scratch, key, text);
            },
            limits...);
    });
    command.flag(
        "--no-dimming", [&given] { given.emplace_back("dynamicOcclusion", "false"); },
        "The same as --dynamic-occlusion false");
}

void applyRelightOptions(const GivenSettings& given, RelightSettings& settings) {
    for (const auto& [key, text] : given)
        setRelightSetting(settings, key, text);
}

} // namespace limn
