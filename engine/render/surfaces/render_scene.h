// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/lightmap/lightmap_layout.h"
#include "engine/scene/scene.h"

#include <array>
#include <memory>
#include <vector>

namespace limn::render {

/// What shading reads of a vertex besides its position; locations 1 to 5 of surface.vert.
struct VertexAttributes {
    glm::vec3 normal{0, 0, 1};
    glm::vec4 tangent{1, 0, 0, 1};
    glm::vec2 uv0{0}, uv1{0};
    glm::vec4 color{1};
};
static_assert(sizeof(VertexAttributes) == 60);

/// Triangles of a mesh that are culled together where shadow maps look another way.
constexpr std::uint32_t kChunkTriangles = 256;

/// A mesh on the GPU, its vertices cut along charts where the layout says so.
struct GpuMesh {
    gpu::Buffer positions;  ///< vec3
    gpu::Buffer attributes; ///< VertexAttributes
    gpu::Buffer indices;    ///< uint32
    std::uint32_t indexCount = 0;
    std::uint32_t vertexCount = 0;
    bool tangents = false;
    Bounds bounds;              ///< object space
    std::vector<Bounds> chunks; ///< of each kChunkTriangles triangles; object space
};

struct GpuInstance {
    std::uint32_t mesh = 0, material = 0;
    glm::mat4 toWorld{1};
    bool mirrored = false;
    bool hasLightmap = false;
    gpu::Buffer lightmapUv; ///< vec2 per vertex; empty without lightmap
    float backOffset = 0;   ///< of limn::backOffset
    Bounds bounds;          ///< world space
};

/// Geometry as the passes draw it.
struct RenderScene {
    std::shared_ptr<const Assets> assets;
    std::shared_ptr<const LightmapLayout> layout;
    std::vector<GpuMesh> meshes; ///< as Assets::meshes
    std::vector<GpuInstance> instances;
    gpu::Buffer lookupSnaps; ///< LightmapLayout::snaps; empty: none
    glm::vec2 lookupSize{0}; ///< the lightmap's size in texels; 0: no snaps
    Bounds bounds;
    /// Grows when anything that casts a shadow changed: meshes, instances, transforms, masks.
    std::uint64_t version = 0;
};

/// Brings `target` up to date; uploads meshes only when assets or layout are others than last time.
/// A layout that does not fit the scene's instances is left out, instance by instance.
void updateRenderScene(gpu::Device& device, RenderScene& target, const Scene& scene,
                       std::shared_ptr<const LightmapLayout> layout);

/// World-space bounds of transformed bounds.
Bounds transformBounds(const Bounds& bounds, const glm::mat4& m);

/// False when no point of `bounds` can be inside the clip volume of `toClip` (depth [0, 1]).
bool mayBeVisible(const Bounds& bounds, const glm::mat4& toClip);

/// From `p` to the nearest point of `bounds` [m].
float distanceTo(const Bounds& bounds, glm::vec3 p);

/// No more than the distance from `eye` to the nearest surface inside `toClip` [m], by the bounds
/// of its triangles; infinity where there is none.
float nearestInSight(const RenderScene& scene, const glm::mat4& toClip, glm::vec3 eye);

} // namespace limn::render
