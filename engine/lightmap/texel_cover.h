// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/atlas.h"
#include "engine/lightmap/chart_places.h"

#include <cstdint>
#include <vector>

namespace limn {

/// A texel of a place, with the surface points that it represents.
struct LocalTexel {
    glm::uvec2 position;
    std::uint32_t count;
    std::array<MeshPoint, AtlasTexel::kMaxPoints> points;
};

/// A triangle with its corners in texels; the first texel's centre is (1/2, 1/2).
struct FlatTriangle {
    std::uint32_t triangle;
    std::array<glm::vec2, 3> corner;
};

/// Texels of a rectangle of `size` that a bilinear lookup on non-overlapping triangles can read.
std::vector<LocalTexel> coverTriangles(const std::vector<FlatTriangle>& triangles, glm::uvec2 size);

/// Texels of `place` that a bilinear lookup on its triangles can read.
std::vector<LocalTexel> coverTexels(const AtlasInput& in, const ChartPlace& place);

/// Number of those texels, computed without their points. `scratch` is working space.
std::uint32_t countTexels(const AtlasInput& in, const ChartPlace& place,
                          std::vector<std::uint8_t>& scratch);

} // namespace limn
