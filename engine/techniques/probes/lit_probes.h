// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/probes/probe_light.h"
#include "engine/techniques/probes/probe_maps.h"

#include <cstdint>
#include <vector>

namespace limn {

/// A probe's state.
struct ProbeAge {
    std::uint32_t updates = 0; ///< since it was lit: 0 by the last one
    bool stale = false;        ///< what it shows has changed since
    bool lit = false;          ///< it ever was
};

/// Lit probes, copied.
struct LitProbes {
    ProbeMaps maps;
    std::vector<ProbeHarmonics> light; ///< per probe, radiance [W m^-2 sr^-1]
    std::vector<ProbeAge> ages;        ///< per probe
};

} // namespace limn
