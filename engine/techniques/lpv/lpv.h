// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

namespace limn {

/// Light propagation volumes: one bounce of the scene's lights, carried from cell to cell of a
/// lattice. Nothing is precomputed.
extern const Technique kLpvTechnique;

} // namespace limn
