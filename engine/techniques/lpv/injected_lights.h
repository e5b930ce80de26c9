// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lattice/cell_lobes.h"
#include "engine/lattice/lattice.h"
#include "engine/techniques/lpv/propagation.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace limn {

/// What an instance sends, summed by cell.
struct InjectedInstance {
    std::uint32_t instance; ///< index into Scene::instances
    std::vector<CellLobe> cells;
};

/// A texel of a reflective shadow map, kept for overlays.
struct ShownTexel {
    glm::vec3 position{0};
    glm::vec3 normal{0};    ///< unit, geometric, of the lit side
    glm::vec3 reflected{0}; ///< flux of a light of colour 1 and strength 1, in RsmTexel's unit
};

/// What surfaces reflect of a light of colour 1 and strength 1.
struct InjectedLight {
    Light shape; ///< unitLight()
    std::vector<InjectedInstance> parts;
    std::vector<ShownTexel> texels; ///< of its shadow map, evenly spread, at most kShownTexels
    std::uint64_t allTexels = 0;    ///< number of those that reflect anything
    std::uint64_t rays = 0;         ///< of its shadow map
};

/// Number of texels of a light that are kept for overlays.
inline constexpr std::size_t kShownTexels = 4096;

/// Casts the light's shadow map and injects its texels half a cell off their surfaces, each as a
/// lobe of the flux that it reflects. Incomplete when cancelled.
InjectedLight injectLight(const TraceScene& trace, const Scene& scene, const Light& light,
                          std::uint32_t mapSize, const Lattice& lattice,
                          const Progress& progress = {});

/// Injects what emissive surfaces send in pieces of up to half a cell, likewise, from each side
/// that emits.
std::vector<InjectedInstance> injectEmitters(const Scene& scene, const Lattice& lattice);

/// Adds the light in the given colour to `cells`, without that of the instances in `black`.
void addInjected(std::span<const InjectedInstance> parts, glm::vec3 colour, const Lattice& lattice,
                 std::span<const std::uint32_t> black, CellLight& cells);

} // namespace limn
