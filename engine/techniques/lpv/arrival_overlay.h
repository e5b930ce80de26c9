// SPDX-License-Identifier: MIT
#pragma once

#include "engine/overlay/overlay_data.h"
#include "engine/scene/scene.h"
#include "engine/techniques/lpv/lit_lattice.h"

namespace limn {

/// The round after which light arrives in the cell before each surface. `scene` is the one that
/// the lattice lights.
OverlayData arrivalOverlay(const LitLattice& lit, const Scene& scene);

} // namespace limn
