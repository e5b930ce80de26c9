// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

namespace limn {

/// The technique that lights a bake, by the paper's method. Its precomputed data is a
/// BakedIlluminance.
extern const Technique kIlluminanceTechnique;

} // namespace limn
