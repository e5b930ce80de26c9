// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/trace/trace_scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Virtual area lights: the texels of a light's reflective shadow map, as discs that send what they
/// reflect of a light of colour 1 and strength 1.
struct VirtualLights {
    std::array<std::vector<float>, 3> position; ///< x, y, z [m]
    std::array<std::vector<float>, 3> normal;   ///< unit, of the lit side
    std::array<std::vector<float>, 3> flux;     ///< reflected, RGB, in RsmTexel's unit
    std::vector<float> area;                    ///< across the beam [m^2]
    std::vector<std::uint32_t> instance;        ///< index into Scene::instances
    std::vector<std::uint32_t> cell;            ///< in the raster, ascending
    /// The raster: the views of the light side by side, texel (x, y) of a view in cell (view size
    /// + x) rows + y.
    std::uint32_t columns = 0, rows = 0;
    std::uint64_t rays = 0; ///< cast for the map

    std::size_t size() const { return area.size(); }
    glm::vec3 positionOf(std::size_t i) const {
        return {position[0][i], position[1][i], position[2][i]};
    }
    glm::vec3 normalOf(std::size_t i) const { return {normal[0][i], normal[1][i], normal[2][i]}; }
    glm::vec3 fluxOf(std::size_t i) const { return {flux[0][i], flux[1][i], flux[2][i]}; }
    std::uint64_t bytes() const;

    /// Appends a light in `at`, a cell behind all others.
    void add(glm::vec3 p, glm::vec3 n, glm::vec3 reflected, float discArea, std::uint32_t of,
             std::uint32_t at);
};

/// Casts the light's map. Incomplete when cancelled.
VirtualLights castVirtualLights(const TraceScene& trace, const Scene& scene, const Light& light,
                                std::uint32_t mapSize, const Progress& progress = {});

} // namespace limn
