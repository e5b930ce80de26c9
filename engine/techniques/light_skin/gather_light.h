// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/light_skin/importance.h"
#include "engine/techniques/light_skin/light_caches.h"
#include "engine/techniques/light_skin/virtual_lights.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Chosen virtual lights in the order in which they are read, padded with lights that send nothing.
struct GatheringLights {
    std::array<std::vector<float>, 3> position, normal;
    std::array<std::vector<float>, 3> flux; ///< times the weight
    std::vector<float> area, weight;
    /// Sums of weight times epsilon A / D^2, and of these times the first and second powers of the
    /// positions.
    double allWeight = 0;
    glm::dvec3 allFirst{0}, allSecond{0};

    std::size_t bytes() const { return 11 * sizeof(float) * weight.size(); }
};
/// `diagonal`: D, of the scene [m].
GatheringLights gatheringLights(const VirtualLights& lights, const ChosenLights& chosen,
                                float diagonal);

/// What a cache receives of one kind of light, from a light of colour 1 and strength 1.
struct ProxySums {
    glm::vec3 light{0};  ///< irradiance E, or reflected radiance G of a surface with F0 = 1
    float weight = 0;    ///< sum of w
    glm::vec3 first{0};  ///< sum of w d, where d is the way from the cache to a virtual light [m]
    glm::vec3 second{0}; ///< sum of w d^2 along each axis
};
struct CacheSums {
    ProxySums diffuse, glossy;
};

/// The unit way from the eye to a point, mirrored at a surface there with unit `normal`; the normal
/// where both coincide.
glm::vec3 mirroredWay(glm::vec3 position, glm::vec3 normal, glm::vec3 eye);

/// A cache as it gathers.
struct GatheringCache {
    glm::vec3 position{0}, normal{0};
    glm::vec3 mirrored{0}; ///< mirroredWay(); 0: it gathers nothing glossy
    float exponent = 1;    ///< of its lobe about `mirrored`
};

/// Weight of virtual lights that do not light a cache, so that it has a proxy all the same, as a
/// share of the form factor of a disc as far away as the scene is large.
inline constexpr float kProxyEpsilon = 1e-6f;

/// Sums of a cache over virtual lights of flux Phi, area A and weight g:
///   E = sum g Phi cos+ cos+ / (A + pi r^2),               w = g (epsilon A / D^2 + F)
///   G = sum g Phi (k + 2) / 2 pi cos^k cos+ cos+ / (A + pi r^2),   w = g (... + cos^k F)
/// with F = A cos+ cos+ / (A + pi r^2). Bischoff, Schwandt, Broll. 2017, equations 3 to 6 and 13 to
/// 15, the last of which lacks the cosines. In the paper epsilon stands alone. It then outweighs F
/// where texels are small, and draws proxies to the mean of what does not light them.
CacheSums gatherLight(const GatheringLights& from, const GatheringCache& cache);

/// The same for all caches. `eye` null: nothing glossy. `sums` is incomplete when cancelled.
void gatherLights(const LightCaches& caches, std::span<const float> exponents,
                  const GatheringLights& from, const glm::vec3* eye, std::vector<CacheSums>& sums,
                  const Progress& progress = {});

/// Cache `c` of those, as it gathers.
GatheringCache gatheringCache(const LightCaches& caches, std::span<const float> exponents,
                              const glm::vec3* eye, std::size_t c);

} // namespace limn
