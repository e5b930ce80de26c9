// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Direct light at the surfels, stored per light as the irradiance from a white light of unit
/// strength at the same place. Changing a colour or a strength traces no ray.
struct SurfelLight {
    /// Number of shadow rays from a surfel to a rectangle.
    static constexpr std::uint32_t kRectanglePoints = 16;

    struct PerLight {
        Light light; ///< as traced
        std::vector<float>
            share; ///< irradiance / (color * strength) at each surfel, shadow included
    };
    std::vector<PerLight> lights;
    std::uint64_t occluders = 0; ///< hash of the instances that the shadows belong to
    std::vector<Light> summed;   ///< lights that `irradiance` sums, without names
    Bounds bounds;               ///< of the surfels

    std::vector<glm::vec3> irradiance; ///< [W m^-2] per surfel, all lights
    std::uint32_t lightsTraced = 0;    ///< by the last update
    std::uint64_t raysTraced = 0;      ///< by the last update

    // Buffers of the previous update, whose memory the next one reuses.
    std::vector<Light> wanted;
    std::vector<PerLight> known;
    std::vector<glm::vec3> before;
};

/// Brings `state` up to date with the scene's lights. Lights that are off, black, of no strength,
/// out of reach of every surfel, or unchanged cost nothing. Returns true if any irradiance changed.
bool updateSurfelLight(const Surfels& surfels, const Scene& scene, const TraceScene& trace,
                       SurfelLight& state);

} // namespace limn
