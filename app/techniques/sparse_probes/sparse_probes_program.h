// SPDX-License-Identifier: MIT
#pragma once

#include "app/techniques/technique_program.h"

namespace limn {

/// The program's part of lighting by sparse probes.
extern const TechniqueProgram kSparseProbesProgram;

} // namespace limn
