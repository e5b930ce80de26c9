// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

namespace limn {

/// Light field probes: McGuire, Mara, Nowrouzezahrai, Luebke. Real-Time Global Illumination using
/// Precomputed Light Field Probes. 2017. A lattice of probes keeps maps of what it sees. When light
/// changes, the maps are lit anew, a few probes at a time, and surfaces blend the irradiance of the
/// eight probes around them by what those see.
///
/// Two things differ from the paper. Maps are traced, and hits are kept and lit again, where the
/// paper draws six pictures of each probe. Irradiance is kept as three bands of spherical harmonics
/// instead of a filtered octahedral map: its error for clamped cosines is below 1 %, except below
/// small bright sources. On the CPU, glossy reflections are marched through the maps for pictures
/// that ask for it (LightingInput::reflections); else surfaces reflect the harmonics.
extern const Technique kProbesTechnique;

} // namespace limn
