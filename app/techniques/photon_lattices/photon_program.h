// SPDX-License-Identifier: MIT
#pragma once

#include "app/techniques/technique_program.h"

namespace limn {

/// The part of the program that knows photon lattices.
extern const TechniqueProgram kPhotonProgram;

void addPhotonBench(Command& bench); ///< "photons"

} // namespace limn
