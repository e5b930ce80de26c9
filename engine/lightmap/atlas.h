// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <array>
#include <cstdint>
#include <vector>

namespace limn {

struct SurfaceHit;

/// A texel that a bilinear lookup can read, with sample points on the side of the surface that it
/// represents: points spread over the part of the surface inside the texel, or the closest surface
/// point if there is none inside.
struct AtlasTexel {
    /// 7 is not a Fibonacci number: every seventh direction of a Fibonacci lattice is again well
    /// spread.
    static constexpr std::uint32_t kMaxPoints = 7;

    std::uint32_t texel;     ///< y * width + x
    std::uint32_t instance;  ///< index into Scene::instances
    std::uint32_t back;      ///< 1: it represents the back of a two-sided surface
    float width = 0;         ///< [m]
    std::uint32_t count = 0; ///< number of points, [1, kMaxPoints]
    std::array<MeshPoint, kMaxPoints> points;
};

struct Atlas {
    LightmapLayout layout;
    std::vector<AtlasTexel> texels; ///< ordered by texel; each texel once
    /// Per texel, whether any of its points is open; empty until findTexelSides() has computed it.
    std::vector<std::uint8_t> open;
    float texelsPerMetre = 0; ///< world density used
    /// First row of each level of the texels that findLampLookups() adds, the coarsest first.
    std::vector<std::uint32_t> lampRows;
};

/// Places the charts of every static instance in one atlas. A chart of extent e metres gets round(e
/// * density) + 1 texels per side, with its borders on texel centres, so that bilinear lookups stay
/// inside without padding, but at least two texels on a side longer than an eighth of a texel.
/// Charts smaller than that share texels with neighbours of similar orientation. A two-sided
/// surface gets two places of the same shape, one per side, because each side is lit independently.
/// The density is settings.texelsPerMetre, or found by bisection so that lookups read about
/// settings.lightmapCaches texels. `charts` are per mesh, as Assets::meshes. Of the instances only
/// mesh, dynamic, atlasScale and whether they are two-sided are read. The result is incomplete when
/// cancelled.
Atlas buildAtlas(const Scene& scene, std::vector<MeshCharts> charts, const BakeSettings& settings,
                 std::vector<std::vector<float>> factors = {}, const Progress& progress = {});

/// Number of texels that the bake settings ask for: lightmapCaches, or texelsPerMetre squared times
/// the area of the lit sides of all static instances.
double wantedTexels(const Scene& scene);

/// Mean length scale of the instance's transform, rounded to 12 bits.
float atlasScale(const Instance& instance);

/// The four texels and weights of a bilinear lookup at normalised `uv`. Indices are y * width + x,
/// clamped to the atlas.
struct Bilinear {
    std::uint32_t texel[4];
    float weight[4];
};
Bilinear bilinearAt(const LightmapLayout& layout, glm::vec2 uv);

/// Layout of a scene in which no instance has a lightmap and the grid lights all of them.
LightmapLayout layoutWithoutLightmap(const Scene& scene);

/// Offset in v from an instance's front to its back, in normalised atlas coordinates.
float backOffset(const LightmapLayout& layout, std::uint32_t instance);

/// A bilinear lookup, resolved to the finest texels that cover it.
struct AtlasLookup {
    glm::vec2 base;      ///< coordinates of the upper left of its four texels
    glm::vec2 f;         ///< position between that texel and the next ones, in [0, 1)^2
    std::uint32_t snaps; ///< LightmapLayout::snaps of that position
    bool inside;         ///< whether it lies in the atlas; otherwise it has no snap
    float width;         ///< of its texels, over that of the coarsest at this place
};
AtlasLookup lookupAt(const LightmapLayout& layout, glm::vec2 uv);

/// Redirects a lookup to the finest texels and to its own side of walls, by LightmapLayout::snaps.
/// Must not be applied twice.
glm::vec2 snapLookup(const LightmapLayout& layout, glm::vec2 uv);

/// Normalised coordinate of the lookup at `f`, in [0, 1]^2, between the texel at whole coordinates
/// `base` and the next ones, after applying `snap`, one of the kSnaps.
glm::vec2 snappedUv(const LightmapLayout& layout, glm::vec2 base, glm::vec2 f, std::uint32_t snap);

/// lightmapUv() without snapping.
glm::vec2 unsnappedUv(const LightmapLayout& layout, std::uint32_t instance, std::uint32_t mesh,
                      std::uint32_t triangle, float u, float v, bool back);

/// Normalised, snapped atlas coordinate of the lookup at barycentrics (u, v) of a triangle, on its
/// back if `back`; a one-sided surface always uses its front. Precondition: the instance has a
/// lightmap.
glm::vec2 lightmapUv(const LightmapLayout& layout, std::uint32_t instance, std::uint32_t mesh,
                     std::uint32_t triangle, float u, float v, bool back);

/// The lookup at the side of a surface that a ray met. Precondition: its instance has a lightmap.
Bilinear bilinearAt(const LightmapLayout& layout, const Scene& scene, const SurfaceHit& hit);

} // namespace limn
