// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/probe_settings.h"

namespace limn {

ProbeSettings probeSettingsOf(const TechniqueChoice& choice) {
    return {.count = std::uint32_t(settingOf(choice, kProbeCount)),
            .side = std::uint32_t(settingOf(choice, kProbeSide)),
            .perUpdate = std::uint32_t(settingOf(choice, kProbesPerUpdate)),
            .smooth = settingOf(choice, kSmoothProbes) > 0,
            .bounces = settingOf(choice, kProbeBounces) > 0,
            .reflections = settingOf(choice, kProbeReflections) > 0};
}

} // namespace limn
