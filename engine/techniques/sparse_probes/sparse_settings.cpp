// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/sparse_settings.h"

namespace limn {

SparseSettings sparseSettingsOf(const TechniqueChoice& choice) {
    SparseSettings settings;
    visitSparseSettings(settings, [&](const TechniqueSetting& setting, std::uint32_t& value) {
        value = std::uint32_t(settingOf(choice, setting));
    });
    return settings;
}

bool clampsParts(const TechniqueChoice& choice) {
    return settingOf(choice, kSparseSettings.back()) > 0;
}

} // namespace limn
