// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lattice/lattice.h"
#include "engine/techniques/lpv/injected_lights.h"
#include "engine/techniques/lpv/propagation.h"

#include <cstdint>
#include <vector>

namespace limn {

/// A texel of a reflective shadow map as injected.
struct InjectedTexel {
    ShownTexel surface;
    glm::vec3 flux{0}; ///< that it reflects [W]
};

/// A lit lattice, copied.
struct LitLattice {
    Lattice lattice;
    CellLight injected;
    std::vector<Lobe> sum; ///< intensity that leaves each cell, over all rounds [W sr^-1]
    FaceBlockers blockers;
    std::vector<InjectedTexel> texels; ///< some of them
    std::uint64_t allTexels = 0;       ///< number of those injected
    std::uint32_t rounds = 0;          ///< of propagation
};

} // namespace limn
