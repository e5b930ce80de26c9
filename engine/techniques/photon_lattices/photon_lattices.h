// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

namespace limn {

/// Image space light lattice photon mapping: photons of lights, traced and summed in lattices of
/// three sizes, from soft light to caustics. Nothing is precomputed.
extern const Technique kPhotonTechnique;

} // namespace limn
