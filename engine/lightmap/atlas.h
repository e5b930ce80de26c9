// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/lightmap_layout.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <array>
#include <cstdint>
#include <vector>

namespace limn {

/// A texel that a bilinear lookup can meet, and the side of the surface it stands for: points
/// spread over the part of the surface that lies in it; the closest point where none does.
struct AtlasTexel {
    /// Not a Fibonacci number: every seventh direction of a Fibonacci lattice is again well spread.
    static constexpr std::uint32_t kMaxPoints = 7;

    std::uint32_t texel;     ///< y * width + x
    std::uint32_t instance;  ///< index into Scene::instances
    std::uint32_t back;      ///< 1: it stands for the back of a two-sided surface
    float width = 0;         ///< [m]
    std::uint32_t count = 0; ///< of points, [1, kMaxPoints]
    std::array<MeshPoint, kMaxPoints> points;
};

struct Atlas {
    LightmapLayout layout;
    std::vector<AtlasTexel> texels; ///< ordered by texel; each texel once
    /// Per texel, whether some point of it lies open; empty until findTexelSides() says.
    std::vector<std::uint8_t> open;
    float texelsPerMetre = 0; ///< world density used
};

/// Places every static instance's charts in one atlas. A chart of extent e metres gets round(e *
/// density) + 1 texels a side, its borders on texel centres, so bilinear lookups stay inside
/// without padding; a side under half a texel becomes one texel; charts smaller than that in both
/// share a texel with their neighbours of like orientation. A two-sided surface has two places of
/// like shape, one for each side: light on one side says nothing about the other. The density is
/// settings.texelsPerMetre, or found by bisection so that about settings.lightmapCaches texels are
/// met. `charts` per mesh, as Assets::meshes. Of the instances it reads only mesh, dynamic,
/// atlasScale and whether they are two-sided. Unfinished when cancelled.
Atlas buildAtlas(const Scene& scene, std::vector<MeshCharts> charts, const BakeSettings& settings,
                 std::vector<std::vector<float>> factors = {}, const Progress& progress = {});

/// How many texels the bake settings ask for: lightmapCaches, or as many as texelsPerMetre squared
/// gives on the lit sides of all static instances.
double wantedTexels(const Scene& scene);

/// Mean length scale of the instance's transform, rounded to 12 bits.
float atlasScale(const Instance& instance);

/// The four texels and weights of a bilinear lookup at normalised `uv`; indices y * width + x,
/// clamped to the atlas.
struct Bilinear {
    std::uint32_t texel[4];
    float weight[4];
};
Bilinear bilinearAt(const LightmapLayout& layout, glm::vec2 uv);

/// The layout of a scene in which no instance has a place in the lightmap: all are lit from the
/// grid.
LightmapLayout layoutWithoutLightmap(const Scene& scene);

/// How far below an instance's front its back lies, in normalised atlas coordinates.
float backOffset(const LightmapLayout& layout, std::uint32_t instance);

/// A lookup between four texels, the finest ones there are.
struct AtlasLookup {
    glm::vec2 base;      ///< the first of them
    glm::vec2 f;         ///< between it and the next ones, in [0, 1)^2
    std::uint32_t snaps; ///< LightmapLayout::snaps of that place
    bool inside;         ///< the atlas; else no snap
};
AtlasLookup lookupAt(const LightmapLayout& layout, glm::vec2 uv);

/// Moves a lookup to the finest texels and to the side of walls that it belongs to:
/// LightmapLayout::snaps. Not to be applied
/// twice.
glm::vec2 snapLookup(const LightmapLayout& layout, glm::vec2 uv);

/// The lookup at `f`, in [0, 1]^2, between texel `base`, whole, and the next ones, after one of the
/// kSnaps.
glm::vec2 snappedUv(const LightmapLayout& layout, glm::vec2 base, glm::vec2 f, std::uint32_t snap);

/// lightmapUv() before it is snapped.
glm::vec2 unsnappedUv(const LightmapLayout& layout, std::uint32_t instance, std::uint32_t mesh,
                      std::uint32_t triangle, float u, float v, bool back);

/// Normalised atlas coordinate of the lookup at barycentrics (u, v) of a triangle, of its back
/// where `back`; on a one-sided surface both are its front. Snapped. Precondition: the instance has
/// a lightmap.
glm::vec2 lightmapUv(const LightmapLayout& layout, std::uint32_t instance, std::uint32_t mesh,
                     std::uint32_t triangle, float u, float v, bool back);

} // namespace limn
