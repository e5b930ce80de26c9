// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// What a light sees through a texel: a piece of a lit surface.
struct RsmTexel {
    std::uint32_t view = 0;     ///< index into the light's rsmViews()
    glm::uvec2 place{0};        ///< of the texel in the view's raster
    std::uint32_t instance = 0; ///< index into Scene::instances
    std::uint32_t triangle = 0;
    float u = 0, v = 0; ///< barycentrics of the middle, weights (1-u-v, u, v)
    glm::vec3 position{0};
    glm::vec3 normal{0};    ///< unit, geometric, of the side that is lit
    glm::vec3 direction{0}; ///< unit, from the light to the piece
    float area = 0;         ///< of the piece, across that direction [m^2]
    glm::vec3 albedo{0};    ///< mean over the piece
    /// Flux that falls on the piece from a light of colour 1 and strength 1: [m^2] for Directional,
    /// [sr] for Point and Spot, [m^2 sr] for Rectangle. Times colour and strength it is in [W].
    float incident = 0;
};

/// The surfaces that a light reaches first, in a regular raster of the light's directions.
/// Dachsbacher, Stamminger. Reflective Shadow Maps. 2005
struct ReflectiveShadowMap {
    std::vector<RsmTexel> texels; ///< that the light reaches, in the order of the raster
    std::uint64_t rays = 0;       ///< traced for it
};

/// A square of texels: through each runs a ray, parallel to the others or from a point. Texel (x,
/// y) has its ray through at.x right + at.y up, with at = 2 (x + 0.5, y + 0.5) / size - 1.
struct RsmView {
    glm::vec3 origin{0};       ///< of the rays, or the middle of their origins
    glm::vec3 forward{0};      ///< unit
    glm::vec3 right{0}, up{0}; ///< from the middle to the edges; at distance 1
    bool parallel = false;
    std::uint32_t size = 1; ///< texels along a side
    float power = 1;        ///< factor of the incident flux

    /// Area of all texels, at distance 1 where rays part.
    float area() const { return 4 * glm::length(right) * glm::length(up); }
    /// Area of one of them.
    float texelArea() const { return area() / (float(size) * float(size)); }
};

/// The views of a light over a scene with these bounds, all of the same size. `clearOf` moves a
/// point of a rectangle off it along the normal. Empty for a sun over a scene without extent.
std::vector<RsmView>
rsmViews(const Light& light, const Bounds& bounds, std::uint32_t size,
         const std::function<glm::vec3(glm::vec3 p, glm::vec3 normal)>& clearOf);

/// Which texels a map keeps.
enum class RsmTexels : std::uint8_t {
    Diffuse, ///< those whose albedo is above 0
    All      ///< also those that reflect nothing diffusely, such as metals
};

/// Casts the map of a light as unitLight() makes it: lights that this makes equal have equal maps.
/// `size`: texels along the side of a view, >= 1. A sun has one view, over the scene's bounds. A
/// spot of up to 60 degrees has one, any other spot and a point light have the six faces of a cube.
/// A rectangle is four point lights in the middles of its quarters, each with a cube of half the
/// size. Materials are those of `scene`; `trace` may be of an older scene of equal geometry. The
/// result is incomplete when cancelled.
ReflectiveShadowMap castRsm(const TraceScene& trace, const Scene& scene, const Light& light,
                            std::uint32_t size, const Progress& progress = {},
                            RsmTexels kept = RsmTexels::Diffuse);

} // namespace limn
