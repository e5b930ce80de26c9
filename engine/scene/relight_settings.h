// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/setting.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace limn {

/// How bounced light is brought up to date while a document is open. No bake depends on it. One per
/// document.
struct RelightSettings {
    std::uint32_t maxBounces = 1000; ///< updates stop earlier once the light has converged
    float tolerance = 0.01f;         ///< change that converged light may still be due [%]
    bool dynamicOcclusion = true;    ///< dynamic objects occlude bounced light

    bool operator==(const RelightSettings&) const = default;
};

/// Up to this many bounces are computed exactly as requested (RelightSettings::maxBounces): every
/// change restarts from zero bounced light. With more bounces, lighting continues from the previous
/// light.
inline constexpr std::uint32_t kFewBounces = 8;

/// Describes which setting is out of its range; empty if all are valid.
std::string settingsDefect(const RelightSettings& settings);

/// Sets the setting `key` to the value in `text`. Returns an empty string on success; otherwise a
/// description of what is wrong with the text, and nothing changes. Precondition: the setting
/// exists.
std::string setRelightSetting(RelightSettings& settings, std::string_view key,
                              const std::string& text);

/// Calls visit(setting, value) for a switch and visit(setting, value, range or choices) for any
/// other setting, once for each. `s` is a RelightSettings, const or not.
template <class S, class Visit>
void visitRelightSettings(S& s, const Visit& visit) {
    visit(Setting{.key = "maxBounces",
                  .flag = "--max-bounces",
                  .label = "Maximum bounces",
                  .help = "Maximum number of bounces of light",
                  .tooltip = "Relighting stops as soon as another bounce would change next to "
                             "nothing. With 1, light is reflected once. With up to 8, every change "
                             "starts again without bounced light",
                  .invalidates = Invalidates::Light},
          s.maxBounces, SettingRange{1, 10000});
    visit(Setting{.key = "tolerance",
                  .flag = "--tolerance",
                  .label = "Tolerance (%)",
                  .help = "Change of the light below which bounces end [%]",
                  .tooltip =
                      "Bounces end when all that are still to come would change the light by "
                      "less than this share [%]. Less: closer to the exact light, more "
                      "bounces. More: the light settles sooner",
                  .invalidates = Invalidates::Light},
          s.tolerance, SettingRange{0.001, 10});
    visit(Setting{.key = "dynamicOcclusion",
                  .flag = "--dynamic-occlusion",
                  .label = "Dynamic occlusion",
                  .help = "Dynamic objects occlude bounced light",
                  .tooltip = "Dynamic objects occlude the bounced light of what is behind them",
                  .invalidates = Invalidates::Light},
          s.dynamicOcclusion);
}

} // namespace limn
