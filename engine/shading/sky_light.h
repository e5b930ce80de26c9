// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/sky.h"

#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// A distribution of directions for importance sampling, in proportion to the radiance (mean of R,
/// G, B) of the sky's image. It is empty for other kinds, whose radiance varies too little for
/// importance sampling, and for black images.
struct SkyLight {
    std::vector<double> rows;   ///< cdf over the rows, top first; ends at 1
    std::vector<float> columns; ///< per row: cdf over its pixels
    double total = 0;           ///< integral of the mean of R, G, B over all directions [nits sr]

    bool empty() const { return rows.empty(); }
};

SkyLight findSkyLight(const Sky& sky);

struct SkySample {
    glm::vec3 direction{0, 1, 0}; ///< unit
    glm::vec3 radiance{0};        ///< [nits]
    float pdf = 0;                ///< [sr^-1]
};

/// Samples a direction. `light` is findSkyLight(sky) and not empty; `u` in [0, 1)^2.
SkySample sampleSky(const SkyLight& light, const Sky& sky, glm::vec2 u);

/// Probability density [sr^-1] with which sampleSky() finds a direction of this radiance; 0 if
/// `light` is empty.
float skyPdf(const SkyLight& light, glm::vec3 radiance);

} // namespace limn
