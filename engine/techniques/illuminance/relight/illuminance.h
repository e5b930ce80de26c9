// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

namespace limn {

/// The technique that lights a bake, by the paper's method.
extern const Technique kIlluminanceTechnique;

} // namespace limn
