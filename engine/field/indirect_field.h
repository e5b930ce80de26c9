// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/field_part.h"
#include "engine/field/grid_moments.h"
#include "engine/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

/// Real-time indirect light as pictures sample it: the sum of its parts, each of which is linear in
/// what it stores. Lightmap and grid hold spherical harmonics of incident radiance. Coefficient (l,
/// m) has index i = l(l+1)+m; real, orthonormal, no Condon-Shortley sign. E(n) = max(0, sum A_l c_i
/// Y_i(n)) over the first three bands, A = {pi, 2pi/3, pi/4} [W m^-2]; exitant radiance is albedo E
/// / pi. Reflections read as many of the available bands as they need.
struct IndirectField {
    std::uint32_t bands = 3; ///< [2, 8]; 3 unless a surface of the scene is glossy
    /// Number of bands in colour; the bands above are grey. 0: all bands.
    std::uint32_t chromaBands = 0;

    std::uint32_t lightmapWidth = 0, lightmapHeight = 0; ///< texels; 0: no lightmap
    /// Layer i holds coefficient i: lightmap[(i * height + y) * width + x], RGB in xyz, w = 0.
    /// Texels outside charts are never read by a bilinear lookup; they hold 0 or the light of
    /// surfels' own caches.
    std::vector<glm::vec4> lightmap;
    /// The lightmap's light continues below the surfaces of its texels (engine/math/horizon.h), and
    /// lookups cut it off at the surface that they light.
    bool continues = false;

    glm::uvec3 gridSize{0}; ///< cells; 0: no grid
    Bounds gridBounds;      ///< cell c's centre is lower + (c + 0.5) / gridSize * size
    std::vector<glm::vec4>
        grid; ///< grid[((i * sz + z) * sy + y) * sx + x]; invalid cells are filled
    /// Depth maps, kGridDepthTexels values per cell; null: every point counts as visible from all
    /// cells.
    std::shared_ptr<const std::vector<std::uint16_t>> gridDepth;
    /// Moments of the cells' distances, which weight them in its place; null: not used.
    std::shared_ptr<const GridMoments> gridMoments;
    /// What a technique adds to the light of lightmap and grid.
    std::vector<std::shared_ptr<const FieldPart>> parts;
    std::uint64_t version = 0; ///< incremented with every change of the values above

    /// Whether there is nothing to look up.
    bool empty() const { return lightmapWidth == 0 && gridSize.x == 0 && parts.empty(); }
    std::uint32_t coefficients() const { return bands * bands; }
    std::size_t cells() const { return std::size_t(gridSize.x) * gridSize.y * gridSize.z; }
    std::uint32_t chroma() const {
        return chromaBands == 0 || chromaBands > bands ? bands : chromaBands;
    }
    bool operator==(const IndirectField&) const;
};

} // namespace limn
