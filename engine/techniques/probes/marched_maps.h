// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/bounds.h"
#include "shaders/shared/march_lookup.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

/// What the probes of a grid see, as octahedral maps (engine/math/octahedral.h) through which
/// glossy reflections are marched (march_ray.h): radiance, and the distances and
/// normals of surfaces. McGuire, Mara, Nowrouzezahrai, Luebke. Real-Time Global Illumination using
/// Precomputed Light Field Probes. 2017.
///
/// The paper keeps a distance and a normal per texel. Here both make the plane of the surface, as
/// the vector G = -n / h of its unit normal n, which faces the probe, and the probe's height h
/// above it. A point x, counted from the probe, lies in front of the surface where G x < 1. The
/// inverse 1-norms of points of the plane are linear in the map, as are those of a straight ray.
struct MarchedMaps {
    /// Texels along the side of a texel of `nearest`.
    static constexpr std::uint32_t kBlock = MARCH_BLOCK;
    /// Planes' w: there is no surface, a surface, or the back of a solid, behind which the probe
    /// knows nothing.
    static constexpr auto kSky = float(MARCH_SKY), kSurface = float(MARCH_SURFACE),
                          kSolid = float(MARCH_SOLID);

    glm::uvec3 gridSize{0};        ///< number of probes along each axis
    Bounds gridBounds;             ///< as IndirectField::gridBounds
    std::uint32_t side = 0;        ///< texels along a side of a map
    std::vector<glm::vec4> planes; ///< side^2 per probe: G [1/m], 0 for the sky; kSky etc.
    std::vector<float> nearest;    ///< nearestSide()^2 per probe: inverse of the smallest 1-norm
                                   ///< of a point of the block's planes [1/m]
    std::vector<std::uint8_t> inSolid; ///< per probe: it is not used
    /// Level k holds levelSide(k)^2 texels per probe [W m^-2 sr^-1]. Each level has half the side
    /// of the one before; the last has at most 4.
    std::vector<std::vector<glm::vec3>> radiance;

    std::size_t probes() const { return std::size_t(gridSize.x) * gridSize.y * gridSize.z; }
    std::size_t texels() const { return std::size_t(side) * side; } ///< of a probe
    std::uint32_t nearestSide() const { return (side + kBlock - 1) / kBlock; }
    std::uint32_t levelSide(std::size_t level) const;
    std::size_t bytes() const; ///< memory of the maps
    bool operator==(const MarchedMaps&) const = default;
};

/// Black maps of an empty scene.
MarchedMaps emptyMarchedMaps(glm::uvec3 gridSize, const Bounds& gridBounds, std::uint32_t side);

/// The plane of a surface that a probe sees at `distance` > 0 [m] in unit `direction`, whose unit
/// `normal` faces the probe. `kind`: MarchedMaps::kSurface or kSolid.
glm::vec4 marchedPlane(glm::vec3 direction, float distance, glm::vec3 normal, float kind);

/// Recomputes a probe's `nearest` from its planes.
void updateNearest(MarchedMaps& maps, std::size_t probe);

/// Recomputes the coarser levels of a probe's radiance from the finest.
void updateLevels(MarchedMaps& maps, std::size_t probe);

/// A texel of radiance[level] and its weight in a lookup.
struct MarchedTap {
    std::uint32_t level = 0, index = 0;
    float weight = 0;
};

/// Texels of two levels at most, whose weights sum to 1.
struct MarchedTaps {
    std::size_t count = 0;
    std::array<MarchedTap, 8> tap{};
};

/// The texels of probeRadiance().
MarchedTaps probeTaps(const MarchedMaps& maps, std::size_t probe, glm::vec3 direction,
                      float spread);

/// Radiance that a probe sees in a lobe about `direction`, which is not 0, of which half lies
/// within `spread` [rad]: bilinear, between the two levels whose lookups are about as wide.
glm::vec3 probeRadiance(const MarchedMaps& maps, std::size_t probe, glm::vec3 direction,
                        float spread);

} // namespace limn
