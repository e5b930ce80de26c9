// SPDX-License-Identifier: MIT
#pragma once

#include "engine/final_lightmap/texel_lookups.h"

#include <vector>

namespace limn {

/// One point of an edge at which two charts meet, looked up from both.
struct SeamLookup {
    TexelLookup first, second;
    float length = 0; ///< of the edge that the point stands for, in texels of the first chart
};

/// Points along all edges where two triangles of a mesh meet in different charts and the surface is
/// smooth: their shading normals there differ by less than 2 degrees. Two points for each texel.
std::vector<SeamLookup> findSeams(const Scene& scene, const LitTexels& lit);

} // namespace limn
