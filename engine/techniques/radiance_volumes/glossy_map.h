// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// A hemispherical map of a cache for reflections. What arrives from direction w adds its
/// perpendicular irradiance to the texel of the half vector h between w and the direction to the
/// eye, times (h . w) (m + 8) / (8 pi): the peak of a normalised Blinn-Phong lobe with exponent m =
/// tile^2 - 1, which is about as wide as a texel. A surface is looked up by its normal, rough ones
/// in coarser levels. Reich. Realtime Global Illumination using Dynamic Radiance Volumes. 2015, by
/// its author's program. Levels lie one behind the other, the finest first, row by row.
struct GlossyMapShape {
    std::uint32_t tile = 16; ///< texels along a side, a power of two
    std::uint32_t fill = 0;  ///< levels whose dark texels are filled
    /// The factor is (m + 2) / (8 pi h . w), so that lobes reflect as much of even light at all
    /// angles; the published one reflects cos^2 of it. Kelemen, Szirmay-Kalos. A Microfacet Based
    /// Coupled Specular-Matte BRDF Model with Importance Sampling. 2001, without the Fresnel term.
    bool microfacet = false;

    std::uint32_t levels() const;
    std::size_t firstTexel(std::uint32_t level) const; ///< of all levels
    std::size_t texels() const { return firstTexel(levels()); }
};

/// Axes of the map of a cache, in columns: z towards the eye; of a point with the eye in the same
/// direction, too.
glm::mat3 glossyFrame(glm::vec3 toEye);

/// Maps unit vectors with z >= 0 to the unit square, keeping areas. Shirley, Chiu. A Low Distortion
/// Map Between Disk and Square. 1997
glm::vec2 squareOfHemisphere(glm::vec3 d);
glm::vec3 hemisphereOfSquare(glm::vec2 p);

/// The texel of the finest level to which light from unit `direction` adds, and the factor of its
/// perpendicular irradiance. `frame`: of the cache.
struct GlossySplat {
    std::uint32_t texel = 0;
    float factor = 0;
};
GlossySplat glossySplat(const GlossyMapShape& shape, const glm::mat3& frame, glm::vec3 direction);

/// Makes the coarser levels of a map from the finest one, as means of four texels. Then fills dark
/// texels of the first `fill` levels from the next coarser one; the other texels of four are scaled
/// so that their mean stays.
void completeGlossyMap(const GlossyMapShape& shape, std::span<glm::vec3> texels);

/// Weights of the texels of the finest level, before completeGlossyMap(), in a sum over the
/// completed map's texels with weights `weight`. `finest`: the texels before.
std::vector<glm::vec3> glossyAdjoint(const GlossyMapShape& shape, std::span<const glm::vec3> finest,
                                     std::span<const glm::vec3> weight);

/// Up to eight texels of a map and their weights, whose sum is 1.
struct GlossyLookup {
    std::array<std::uint32_t, 8> texel{};
    std::array<float, 8> weight{};
    std::size_t count = 0;
};
/// The lookup for a surface with unit `normal` in the frame at its own place; none where it faces
/// away from the eye.
GlossyLookup lookUpGlossy(const GlossyMapShape& shape, const glm::mat3& frame, glm::vec3 normal,
                          float roughness);

} // namespace limn
