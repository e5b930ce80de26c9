// SPDX-License-Identifier: MIT
#include "app/techniques/technique_program.h"

#include "app/techniques/illuminance/illuminance_program.h"
#include "app/techniques/photon_lattices/photon_program.h"
#include "app/techniques/sparse_probes/sparse_probes_program.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace limn {

static constexpr std::array kPrograms = {&kIlluminanceProgram, &kSparseProbesProgram,
                                         &kPhotonProgram};

std::span<const TechniqueProgram* const> techniquePrograms() {
    return kPrograms;
}

const TechniqueProgram& programOf(const Technique& technique) {
    const auto* found = std::ranges::find(kPrograms, &technique, &TechniqueProgram::technique);
    assert(found != kPrograms.end());
    return **found;
}

} // namespace limn
