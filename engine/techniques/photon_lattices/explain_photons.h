// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/field_reading.h"
#include "engine/field/indirect_field.h"
#include "engine/lighting/explanation.h"
#include "engine/techniques/photon_lattices/photon_light.h"

namespace limn {

/// Where a reading of `field`, whose parts are photonParts() of `inputs`, comes from: by light and
/// by the surface from which photons arrive. Both are exact, because each photon's share of a
/// reading is its power times a weight. An instance in ExplainOptions::black takes with it all
/// photons that it scattered.
Explanation explainPhotons(const Scene& scene, const PhotonStore& store, const PhotonInputs& inputs,
                           const IndirectField& field, const FieldReading& reading,
                           const ExplainOptions& options);

} // namespace limn
