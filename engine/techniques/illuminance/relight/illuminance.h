// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

namespace limn {

/// The paper's method: it lights a bake.
extern const Technique kIlluminanceTechnique;

} // namespace limn
