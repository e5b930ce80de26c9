// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

namespace limn {

/// What one cache sees of a sender or cluster: sums over rays.
struct Sight {
    float weight = 0;     ///< visible solid angle / pi
    float irradiance = 0; ///< what a radiosity of 1 brings to the cache's surface; for a cache
                          ///< without one side (two-sided, grid) half the weight
    glm::vec3 moment{0};  ///< the weight times the direction

    void operator+=(const Sight& o) {
        weight += o.weight;
        irradiance += o.irradiance;
        moment += o.moment;
    }
};

} // namespace limn
