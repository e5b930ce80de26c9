// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/convergence.h"
#include "engine/techniques/sparse_probes/receivers.h"

#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// What receivers reflect and emit, means over their texels.
struct ReceiverMaterials {
    std::vector<Material> materials;         ///< of the scene, that the values below are of
    std::vector<glm::vec3> albedo, emission; ///< per receiver; emission [W m^-2 sr^-1]
};

/// Brings `state` up to date with the scene's materials. Receivers whose material stayed cost
/// nothing. Returns whether any material changed; true at the first call.
bool updateReceiverMaterials(const Receivers& receivers, const Scene& scene,
                             ReceiverMaterials& state);

/// Tells `convergence` what changed since the last update: how the probes gather (`gathering`, the
/// sky among it), or what receivers get and send without bounces (`light`). Returns whether bounced
/// light must start again from zero.
bool noteChanges(bool gathering, bool light, const RelightSettings& settings,
                 Convergence& convergence);

/// Areas of the receivers' texels.
struct ReceiverAreas {
    std::vector<float> share; ///< of each receiver in the total; 0 where that is 0
    double total = 0;         ///< [m^2]
};
ReceiverAreas areasOf(const Receivers& receivers);

} // namespace limn
