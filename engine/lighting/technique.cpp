// SPDX-License-Identifier: MIT
#include "engine/lighting/technique.h"

#include <algorithm>

namespace limn {

double settingOf(const TechniqueChoice& choice, const TechniqueSetting& setting) {
    const auto found = choice.settings.find(setting.setting.key);
    const double value = found == choice.settings.end() ? setting.usual : found->second;
    return std::clamp(value, setting.range.lower, setting.range.upper);
}

std::string sizeClassOf(const Technique& technique, const Precomputed* data) {
    return data ? data->sizeClass() : technique.name;
}

} // namespace limn
