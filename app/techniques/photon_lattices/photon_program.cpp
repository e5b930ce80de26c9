// SPDX-License-Identifier: MIT
#include "app/techniques/photon_lattices/photon_program.h"

#include "engine/techniques/photon_lattices/photon_lattices.h"

namespace limn {

constinit const TechniqueProgram kPhotonProgram = {
    .technique = &kPhotonTechnique,
    .describe = [](const Precomputed&) { return Json(); }, // nothing is precomputed
    .print = [](const std::string&, const Json&) { return false; },
    .addBenches = addPhotonBench};

} // namespace limn
