// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light.h"
#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Direct light at surface points, stored per light as the irradiance from a white light of unit
/// strength at the same place. Changing a colour or a strength traces no ray.
struct DirectIrradiance {
    /// Number of shadow rays to a rectangle, from all positions of a point together.
    static constexpr std::uint32_t kRectanglePoints = 16;

    struct PerLight {
        Light light; ///< as traced
        std::vector<float>
            share; ///< irradiance / (color * strength) at each point, shadow included
        /// One bit for each position, in words of 64. It is set where the light reaches the front
        /// of the surface and no static instance blocks it. Empty for rectangles, to which a
        /// position sends several rays.
        std::vector<std::uint64_t> open;
    };
    std::vector<PerLight> lights;
    std::uint64_t still = 0, moving = 0; ///< hashes of the instances that the shadows belong to
    std::vector<Light> summed;           ///< lights that `irradiance` sums, without names
    Bounds bounds;                       ///< of the points

    std::vector<glm::vec3> irradiance; ///< [W m^-2] per point, all lights
    std::uint32_t lightsTraced = 0;    ///< by the last update
    std::uint64_t raysTraced = 0;      ///< by the last update

    // Buffers of the previous update, whose memory the next one reuses.
    std::vector<Light> wanted;
    std::vector<PerLight> known;
};

/// Brings `state` up to date with the scene's lights at positions with unit normals, on the side
/// that is lit. Every `each` positions in turn form one point, whose light is the mean over them.
/// Lights that are off, black, of no strength, out of reach of every point, or unchanged cost
/// nothing. Where only dynamic objects have moved, rays are traced against these alone, from the
/// positions that see the light past everything else. Returns true if any irradiance changed. The
/// points are the same at every call with that state.
bool updateDirectIrradiance(std::span<const glm::vec3> positions,
                            std::span<const glm::vec3> normals, const Scene& scene,
                            const TraceScene& trace, DirectIrradiance& state,
                            std::uint32_t each = 1);

} // namespace limn
