// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lattice/cell_lobes.h"
#include "engine/lattice/lattice.h"
#include "engine/techniques/lpv/propagation.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// What surfaces reflect of a light of colour 1 and strength 1, summed by cell.
struct InjectedLight {
    Light shape; ///< rsmShape()
    std::vector<CellLobe> cells;
    std::uint64_t texels = 0, rays = 0; ///< of its shadow map
};

/// Casts the light's shadow map and injects its texels half a cell off their surfaces, each as a
/// lobe of the flux that it reflects. Incomplete when cancelled.
InjectedLight injectLight(const TraceScene& trace, const Scene& scene, const Light& light,
                          std::uint32_t mapSize, const Lattice& lattice,
                          const Progress& progress = {});

/// Adds the light in the given colour [W] to `cells`.
void addLight(const InjectedLight& light, glm::vec3 colour, const Lattice& lattice,
              CellLight& cells);

} // namespace limn
