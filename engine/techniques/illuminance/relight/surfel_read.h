// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"

#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Computes the irradiance [W m^-2] of bounced light that each surfel reads from its four caches,
/// at its normal, never negative. sh: bands^2 coefficients per cache, bands in [2, kMaxBands]; the
/// first kIrradianceBands bands are read. `irradiance` has one entry per surfel.
void readCaches(const Surfels& surfels, const std::vector<glm::vec3>& sh, int bands,
                std::vector<glm::vec3>& irradiance);

} // namespace limn
