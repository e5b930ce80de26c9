// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

namespace limn {

/// Form factor of a sender or cluster as one cache sees it: integrals of the visibility over
/// directions, divided by pi, as sums over rays.
struct FormFactor {
    float solidAngle = 0; ///< integral of the visibility
    float irradiance = 0; ///< the same times the cosine: the irradiance that a radiosity of 1
                          ///< contributes; half of solidAngle for grid cells, which have no normal
    glm::vec3 moment{0};  ///< the same times the direction

    void operator+=(const FormFactor& o) {
        solidAngle += o.solidAngle;
        irradiance += o.irradiance;
        moment += o.moment;
    }
};

} // namespace limn
