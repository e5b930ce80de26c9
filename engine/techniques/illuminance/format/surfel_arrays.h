// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

/// Number of points at which the direct light of a surfel is computed: small patches of sun light a
/// share of it.
inline constexpr std::uint32_t kLightPoints = 4;

/// Area of a surfel that stands for none because others are nearer to all of its surface [m^2].
inline constexpr float kLeastSurfelArea = 1e-30f;

/// Sample points of the static surfaces that stand for all bounced light. Structure of arrays,
/// world space.
struct Surfels {
    std::vector<glm::vec3> position;
    std::vector<glm::vec3> normal;       ///< unit, on the side it stands for: the triangle's while
                                         ///< baking, then the interpolated vertex normal
    std::vector<float> area;             ///< [m^2], > 0; they sum to the area of the lit sides
    std::vector<std::uint32_t> instance; ///< index into Scene::instances
    std::vector<std::uint32_t> triangle; ///< index into the triangles of the instance's mesh
    std::vector<glm::vec2> barycentric;  ///< (u, v), weights (1-u-v, u, v)
    /// Caches from which the surfel reads bounced light: four with bilinear weights; ~0: none.
    std::vector<glm::uvec4> cache;
    std::vector<glm::vec4> cacheWeight;
    /// Points on the surface whose mean direct light is the surfel's, kLightPoints each, and the
    /// unit normals there, on the surfel's side; empty: its own position and normal.
    std::vector<glm::vec3> lightPoints, lightNormals;

    std::size_t size() const { return position.size(); }
    const std::vector<glm::vec3>& litAt() const {
        return lightPoints.empty() ? position : lightPoints;
    }
    /// The normals at the points of litAt().
    const std::vector<glm::vec3>& litNormals() const {
        return lightPoints.empty() ? normal : lightNormals;
    }
    /// Number of points of litAt() per surfel.
    std::uint32_t litAtEach() const { return lightPoints.empty() ? 1 : kLightPoints; }
    bool operator==(const Surfels&) const = default;
};

} // namespace limn
