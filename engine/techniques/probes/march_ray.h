// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/probes/marched_maps.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// A piece of a ray that is straight in a probe's map.
struct RayPiece {
    float from = 0, to = 0;                 ///< along the ray [m]
    glm::vec2 start{0}, end{0};             ///< in the map, in [-1, 1]^2
    float startInverse = 0, endInverse = 0; ///< 1 / 1-norm from the probe [1/m], linear in the map

    /// Place along the ray [m] at share s in [0, 1] of the way through the map.
    float along(float s) const {
        const float a = (1 - s) * startInverse, b = s * endInverse;
        return (a * from + b * to) / (a + b);
    }
};

/// A ray cut where it crosses the probe's three axis planes, so that each piece stays in an octant.
struct RayPieces {
    std::size_t count = 0; ///< 1 to 4, 0 for a ray without length
    std::array<RayPiece, 4> piece{};
};

/// `origin`: of the ray, from the probe [m]; from < to [m].
RayPieces cutRay(glm::vec3 origin, glm::vec3 direction, float from, float to);

enum class MarchEnd : std::uint8_t {
    Hit,    ///< the ray meets a surface that the probe sees
    Miss,   ///< nothing is in its way
    Unknown ///< the ray passes behind what the probe sees
};

/// Where a marched ray ends.
struct MarchedRay {
    static constexpr std::uint32_t kNoProbe = ~0U;

    MarchEnd end = MarchEnd::Unknown;
    std::uint32_t probe = kNoProbe; ///< that says so
    float t = 0;                    ///< [m]; Unknown: from here on nothing is known
};

/// Marches a ray through the map of one probe from `from` [m] on. `direction` is unit, or 0: such a
/// ray is unknown.
MarchedRay marchProbe(const MarchedMaps& maps, std::uint32_t probe, glm::vec3 origin,
                      glm::vec3 direction, float from);

/// Marches a ray through the maps of the eight probes about its origin: first the nearest's; where
/// it passes behind what a probe i sees, it goes on in the map of probe (i + 3) mod 8. Where no
/// probe knows more, the result is Unknown and names the nearest. Probes in solids are skipped.
/// Arguments as of marchProbe().
MarchedRay marchRay(const MarchedMaps& maps, glm::vec3 origin, glm::vec3 direction);

/// Where the light that arrives along a marched ray is looked up: the arguments of probeRadiance().
struct MarchedLookup {
    std::uint32_t probe = MarchedRay::kNoProbe;
    glm::vec3 direction{0};
    float spread = 0; ///< [rad]
};

/// The lookup for a lobe of which half lies within `spread` [rad] of the ray: the point that it
/// hits as its probe sees it, else the probe in the ray's direction.
MarchedLookup lookUp(const MarchedMaps& maps, const MarchedRay& ray, glm::vec3 origin,
                     glm::vec3 direction, float spread);

/// Radiance of a lookup [W m^-2 sr^-1]; 0 where there is no probe or no direction.
glm::vec3 marchedRadiance(const MarchedMaps& maps, const MarchedLookup& lookup);

} // namespace limn
