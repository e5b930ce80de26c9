// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/grid_depth.h"

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Distances from a grid's cells to the surfaces around them, as means and mean squares over cones
/// of directions, and how lookups use them: McGuire, Mara, Nowrouzezahrai, Luebke. Real-Time Global
/// Illumination using Precomputed Light Field Probes. 2017.
struct GridMoments {
    /// kGridDepthTexels per cell, in the octahedral layout of grid_depth.h: mean distance [m] and
    /// mean squared distance [m^2]. 0 in all texels of a cell that lies in a solid: it is never
    /// read.
    std::vector<glm::vec2> texels;
    /// Weights as in Majercik, Guertin, Nowrouzezahrai, McGuire. Dynamic Diffuse Global
    /// Illumination with Ray-Traced Irradiance Fields. 2019. They change more smoothly.
    bool smooth = false;
};

/// Upper bound of the share of a cell's cone at distance `r` [m] that lies in front of the surfaces
/// in it (Chebyshev's inequality): 1 up to the mean distance, then variance / (variance +
/// excess^2). `moments`: mean distance [m] and mean squared distance [m^2].
float shareInFront(glm::vec2 moments, float r);

/// shareInFront() of a cell at a point at offset `way` from its centre [m]; 0 if the cell lies in a
/// solid.
float momentsSeen(const GridMoments& moments, std::uint32_t cell, glm::vec3 way);

/// Weight of a cell for a surface point, besides the trilinear one, in [0, 2). `way`: offset of the
/// point from the cell's centre [m]; `normal`: unit, of the surface.
float momentsWeight(const GridMoments& moments, std::uint32_t cell, glm::vec3 way,
                    glm::vec3 normal);

} // namespace limn
