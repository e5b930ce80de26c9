// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Direct light at the surfels, remembered per light: what a unit-strength white light of the same
/// place brings. Changing a colour or a strength traces no ray.
struct SurfelLight {
    /// Shadow rays from a surfel to a rectangle.
    static constexpr std::uint32_t kRectanglePoints = 16;

    struct PerLight {
        Light light; ///< as traced
        std::vector<float>
            share; ///< irradiance / (color * strength) at each surfel, shadow included
    };
    std::vector<PerLight> lights;
    std::uint64_t occluders = 0; ///< hash of the instances that the shadows belong to
    std::vector<Light> summed;   ///< what `irradiance` is of, without names
    Bounds bounds;               ///< of the surfels

    std::vector<glm::vec3> irradiance; ///< [W m^-2] per surfel, all lights
    std::uint32_t lightsTraced = 0;    ///< by the last update
    std::uint64_t raysTraced = 0;      ///< by the last update

    // Of the update before: memory that the next one writes to.
    std::vector<Light> wanted;
    std::vector<PerLight> known;
    std::vector<glm::vec3> before;
};

/// Brings `state` up to date with the scene's lights. Lights that are off, black, of no strength or
/// out of reach of every surfel cost nothing, and so do lights that stay as they are. Returns true
/// if any irradiance changed.
bool updateSurfelLight(const Surfels& surfels, const Scene& scene, const TraceScene& trace,
                       SurfelLight& state);

} // namespace limn
