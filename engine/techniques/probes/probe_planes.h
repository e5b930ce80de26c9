// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/probes/marched_maps.h"
#include "engine/techniques/probes/probe_maps.h"

#include <cstdint>

namespace limn {

/// Geometric normal of a surface that a probe sees, on the side that it sees; unit. For the back of
/// a solid too. Precondition: `hit` is one of a surface of `scene`.
glm::vec3 seenNormal(const Scene& scene, const ProbeHit& hit);

/// Writes the planes of what a probe sees into maps of the same grid and side, and what follows
/// from them. `seen` holds what the probe sees in `scene`.
void writePlanes(const Scene& scene, const ProbeMaps& seen, std::uint32_t probe, MarchedMaps& maps);

} // namespace limn
