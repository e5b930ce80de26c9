// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/atlas.h"
#include "engine/lightmap/chart_places.h"

#include <cstdint>
#include <vector>

namespace limn {

/// A texel of a place, with the surface points it stands for.
struct LocalTexel {
    glm::uvec2 at;
    std::uint32_t count;
    std::array<MeshPoint, AtlasTexel::kMaxPoints> points;
};

/// A triangle and its corners in texels, the first one's middle at (1/2, 1/2).
struct FlatTriangle {
    std::uint32_t triangle;
    std::array<glm::vec2, 3> corner;
};

/// Texels of `size` that a bilinear lookup on the triangles, which do not overlap, can meet.
std::vector<LocalTexel> coverTriangles(const std::vector<FlatTriangle>& triangles, glm::uvec2 size);

/// Texels of `place` that a bilinear lookup on its triangles can meet.
std::vector<LocalTexel> coverTexels(const AtlasInput& in, const ChartPlace& place);

/// How many those are, without looking for their points. `scratch`: working space.
std::uint32_t countTexels(const AtlasInput& in, const ChartPlace& place,
                          std::vector<std::uint8_t>& scratch);

} // namespace limn
