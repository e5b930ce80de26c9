// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace limn {

/// Where a texel of a PlainLightmap lies on a surface, and what it reads.
struct PlainTexel {
    std::uint32_t instance = 0, triangle = 0; ///< of Scene::instances; of the instance's mesh
    float u = 0, v = 0;                       ///< barycentrics, weights (1-u-v, u, v)
    bool back = false;                        ///< it represents the back of a two-sided surface
    /// Texels of the layout's lightmap, y * width + x, and their weights, which sum to 1.
    glm::uvec4 texel{0};
    glm::vec4 weight{0};
};

/// The lightmap of a layout in a form for programs that look textures up bilinearly and know
/// nothing of LightmapLayout::snaps: each texel holds what the layout's own lookup returns at the
/// surface point closest to the texel's centre. The texture coordinates are those of the layout,
/// before snapping. Texels that no lookup reads repeat their nearest neighbour, so that mips and
/// compressed blocks show no seams.
struct PlainLightmap {
    std::uint32_t width = 0, height = 0;
    std::vector<PlainTexel> texels;     ///< those that a lookup can read
    std::vector<std::uint32_t> texelAt; ///< index into `texels`, at y * width + x
};

/// An element of PlainLightmap::texelAt before it has an index.
inline constexpr std::uint32_t kNoTexel = ~0U;

/// Gives every texel with kNoTexel, in `size.x` columns and `size.y` rows, the index of its nearest
/// neighbour that has one, counted in steps along rows and columns.
void repeatNearest(std::vector<std::uint32_t>& texelAt, glm::uvec2 size);

/// Maximum factor of plainLightmap().
inline constexpr std::uint32_t kMaxPlainFactor = 9;

/// The plain lightmap with `factor` times as many texels along each side as the layout. The factor
/// is odd, so that charts, whose borders lie on centres of texels, keep their borders there, and
/// lookups stay inside. A larger one follows the layout's finer texels and its walls more closely:
/// with a factor of 1 and a layout without snaps, both lookups are equal everywhere. Empty if no
/// instance has a lightmap.
PlainLightmap plainLightmap(const Scene& scene, const LightmapLayout& layout, std::uint32_t factor);

} // namespace limn
