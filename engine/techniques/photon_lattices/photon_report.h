// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting_report.h"
#include "engine/techniques/photon_lattices/photon_light.h"

namespace limn {

/// What an update took, with the making of the field's parts.
struct PhotonUpdateCost : PhotonCost {
    double fieldMs = 0;
};

/// Sets the steps and counters of a report. `inputs` are those of the photons in `store` and of the
/// field's parts.
void describePhotons(const PhotonStore& store, const PhotonInputs& inputs,
                     const IndirectField& field, const PhotonUpdateCost& cost,
                     LightingReport& report);

} // namespace limn
