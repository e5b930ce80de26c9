// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/scene.h"

#include <array>
#include <memory>
#include <vector>

namespace limn::render {

/// Vertex attributes besides the position; locations 1 to 5 of surface.vert.
struct VertexAttributes {
    glm::vec3 normal{0, 0, 1};
    glm::vec4 tangent{1, 0, 0, 1};
    glm::vec2 uv0{0}, uv1{0};
    glm::vec4 color{1};
};
static_assert(sizeof(VertexAttributes) == 60);

/// Number of consecutive triangles of a mesh that shadow maps cull together.
constexpr std::uint32_t kChunkTriangles = 256;

/// A mesh on the GPU, with vertices split along chart borders if the layout has charts for it.
struct GpuMesh {
    gpu::Buffer positions;  ///< vec3
    gpu::Buffer attributes; ///< VertexAttributes
    gpu::Buffer indices;    ///< uint32
    std::uint32_t indexCount = 0;
    std::uint32_t vertexCount = 0;
    bool tangents = false;
    Bounds bounds;              ///< object space
    std::vector<Bounds> chunks; ///< bounds of each kChunkTriangles triangles; object space
};

struct GpuInstance {
    std::uint32_t mesh = 0, material = 0;
    glm::mat4 toWorld{1};
    bool mirrored = false;
    bool hasLightmap = false;
    gpu::Buffer lightmapUv; ///< vec2 per vertex; empty without lightmap
    float backOffset = 0;   ///< see limn::backOffset()
    float nearReach = 0;    ///< see nearReaches() [m]
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
    /// Increases when any shadow caster changed: meshes, instances, transforms, masks.
    std::uint64_t version = 0;
};

/// Brings `target` up to date. Uploads meshes only if assets or layout changed. The layout is
/// ignored for each instance of the scene that it does not fit.
void updateRenderScene(gpu::Device& device, RenderScene& target, const Scene& scene,
                       std::shared_ptr<const LightmapLayout> layout);

/// Axis-aligned bounding box of `bounds` transformed by `m`.
Bounds transformBounds(const Bounds& bounds, const glm::mat4& m);

/// Returns false if no point of `bounds` can be inside the clip volume of `toClip` (depth [0, 1]).
bool mayBeVisible(const Bounds& bounds, const glm::mat4& toClip);

/// Distance from `p` to the nearest point of `bounds` [m].
float distanceTo(const Bounds& bounds, glm::vec3 p);

/// Lower bound of the distance from `eye` to the nearest surface inside `toClip` [m], computed from
/// the bounds of triangles; infinity if there is none.
float nearestInSight(const RenderScene& scene, const glm::mat4& toClip, glm::vec3 eye);

} // namespace limn::render
