// SPDX-License-Identifier: MIT
#include "engine/render/surfaces/render_scene.h"

#include "engine/core/parallel.h"
#include "engine/gpu/uploader.h"
#include "engine/lightmap/atlas.h"
#include "engine/lightmap/near_reach.h"
#include "engine/render/surfaces/uv_slots.h"

#include <algorithm>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn::render {

namespace {

/// Vertices and triangles of a mesh after splitting it along its charts.
struct MeshSource {
    const Mesh& mesh;
    const MeshCharts* charts; ///< null: the mesh as it is

    std::size_t vertexCount() const {
        return charts ? charts->sourceVertex.size() : mesh.positions.size();
    }
    std::size_t source(std::size_t k) const { return charts ? charts->sourceVertex[k] : k; }
    const std::vector<std::uint32_t>& indices() const {
        return charts ? charts->indices : mesh.indices;
    }
};

template <class T>
std::span<const std::byte> bytesOf(const std::vector<T>& v) {
    return std::as_bytes(std::span(v));
}

} // namespace

static std::vector<VertexAttributes> gatherAttributes(const MeshSource& s, const UvSlots& slots) {
    std::vector<VertexAttributes> out(s.vertexCount());
    const Mesh& m = s.mesh;
    const std::vector<glm::vec2>&first = m.uv(slots.set[0]), &second = m.uv(slots.set[1]);
    parallelRanges(out.size(), 16384, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const std::size_t v = s.source(k);
            VertexAttributes& a = out[k];
            if (!m.normals.empty())
                a.normal = m.normals[v];
            if (!m.tangents.empty())
                a.tangent = m.tangents[v];
            if (!first.empty())
                a.uv0 = first[v];
            if (!second.empty())
                a.uv1 = second[v];
            if (!m.colors.empty())
                a.color = m.colors[v];
        }
    });
    return out;
}

static std::vector<Bounds> chunkBounds(const std::vector<glm::vec3>& positions,
                                       const std::vector<std::uint32_t>& indices) {
    constexpr std::size_t step = 3 * kChunkTriangles;
    std::vector<Bounds> chunks((indices.size() + step - 1) / step, kNoBounds);
    for (std::size_t i = 0; i < indices.size(); ++i)
        extend(chunks[i / step], positions[indices[i]]);
    return chunks;
}

static GpuMesh uploadMesh(gpu::Uploader& uploader, const MeshSource& s, const UvSlots& slots) {
    GpuMesh out;
    out.vertexCount = std::uint32_t(s.vertexCount());
    out.indexCount = std::uint32_t(s.indices().size());
    out.tangents = !s.mesh.tangents.empty();
    if (out.indexCount == 0 || out.vertexCount == 0)
        return out;
    std::vector<glm::vec3> positions(out.vertexCount);
    out.bounds = kNoBounds;
    for (std::size_t k = 0; k < positions.size(); ++k) {
        positions[k] = s.mesh.positions[s.source(k)];
        extend(out.bounds, positions[k]);
    }
    out.chunks = chunkBounds(positions, s.indices());
    out.positions =
        uploader.buffer(bytesOf(positions), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "positions");
    out.attributes = uploader.buffer(bytesOf(gatherAttributes(s, slots)),
                                     VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "vertex attributes");
    out.indices =
        uploader.buffer(bytesOf(s.indices()), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, "indices");
    return out;
}

static MeshSource meshSource(const RenderScene& target, std::size_t mesh) {
    const Mesh& m = target.assets->meshes[mesh];
    const LightmapLayout* layout = target.layout.get();
    const bool cut = layout && mesh < layout->meshes.size() &&
                     !layout->meshes[mesh].sourceVertex.empty() &&
                     layout->meshes[mesh].indices.size() == m.indices.size();
    return {m, cut ? &layout->meshes[mesh] : nullptr};
}

static gpu::Buffer uploadLightmapUv(gpu::Uploader& uploader, const RenderScene& target,
                                    std::size_t instance, std::size_t instanceCount,
                                    std::uint32_t vertexCount) {
    const LightmapLayout* layout = target.layout.get();
    if (!layout || layout->instances.size() != instanceCount || vertexCount == 0)
        return {};
    const std::vector<glm::vec2>& uv = layout->instances[instance].uv;
    if (uv.size() != vertexCount)
        return {};
    return uploader.buffer(bytesOf(uv), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "lightmap uv");
}

static void uploadSnaps(gpu::Uploader& uploader, RenderScene& target) {
    target.lookupSnaps = {};
    target.lookupSize = glm::vec2(0);
    const LightmapLayout* layout = target.layout.get();
    if (!layout || layout->snaps.empty())
        return;
    target.lookupSnaps = uploader.buffer(std::as_bytes(std::span(layout->snaps)),
                                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "lookup snaps");
    target.lookupSize = glm::vec2(float(layout->width), float(layout->height));
}

// Whether the instances equal those of the last update except for transforms and materials.
static bool sameInstances(const RenderScene& target, const Scene& scene) {
    if (target.instances.size() != scene.instances.size())
        return false;
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (target.instances[i].mesh != scene.instances[i].mesh)
            return false;
    return true;
}

void updateRenderScene(gpu::Device& device, RenderScene& target, const Scene& scene,
                       std::shared_ptr<const LightmapLayout> layout) {
    const bool newMeshes = target.assets != scene.assets || target.layout != layout;
    bool changed = newMeshes;
    gpu::Uploader uploader(device);
    if (newMeshes) {
        target.assets = scene.assets;
        target.layout = std::move(layout);
        target.meshes.clear();
        uploadSnaps(uploader, target);
        for (std::size_t i = 0; scene.assets && i < scene.assets->meshes.size(); ++i) {
            const std::uint32_t material = scene.assets->meshes[i].material;
            const UvSlots slots =
                material < scene.materials.size() ? uvSlots(scene.materials[material]) : UvSlots();
            target.meshes.push_back(uploadMesh(uploader, meshSource(target, i), slots));
        }
    }
    if (newMeshes || !sameInstances(target, scene)) {
        changed = true;
        target.instances.clear();
        target.instances.resize(scene.instances.size());
        const std::vector<float> reaches = target.layout
                                               ? nearReaches(scene, *target.layout)
                                               : std::vector<float>(scene.instances.size(), 0.f);
        for (std::size_t i = 0; i < scene.instances.size(); ++i) {
            GpuInstance& g = target.instances[i];
            g.mesh = scene.instances[i].mesh;
            g.lightmapUv = uploadLightmapUv(uploader, target, i, scene.instances.size(),
                                            target.meshes[g.mesh].vertexCount);
            g.hasLightmap = bool(g.lightmapUv);
            g.nearReach = g.hasLightmap ? reaches[i] : 0;
            g.backOffset = g.hasLightmap ? backOffset(*target.layout, std::uint32_t(i)) : 0;
        }
    }
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& s = scene.instances[i];
        GpuInstance& g = target.instances[i];
        if (!changed && g.toWorld == s.toWorld && g.material == s.material)
            continue;
        changed = true;
        g.material = s.material;
        g.toWorld = s.toWorld;
        g.mirrored = glm::determinant(glm::mat3(s.toWorld)) < 0;
        g.bounds = transformBounds(target.meshes[g.mesh].bounds, s.toWorld);
    }
    target.bounds = scene.bounds;
    target.version += changed;
}

Bounds transformBounds(const Bounds& bounds, const glm::mat4& m) {
    Bounds out{glm::vec3(m[3]), glm::vec3(m[3])};
    for (int column = 0; column < 3; ++column) {
        const glm::vec3 a = glm::vec3(m[column]) * bounds.lower[column];
        const glm::vec3 b = glm::vec3(m[column]) * bounds.upper[column];
        out.lower += glm::min(a, b);
        out.upper += glm::max(a, b);
    }
    return out;
}

float distanceTo(const Bounds& bounds, glm::vec3 p) {
    return glm::length(glm::clamp(p, bounds.lower, bounds.upper) - p);
}

// Distance to the nearest visible one of triangles [first, end) of an instance; at most `nearest`.
static float nearestTriangle(const Mesh& mesh, const glm::mat4& toWorld, std::size_t first,
                             std::size_t end, const glm::mat4& toClip, glm::vec3 eye,
                             float nearest) {
    for (std::size_t t = first; t < end; ++t) {
        Bounds bounds = kNoBounds;
        for (const std::uint32_t k : mesh.triangle(t))
            extend(bounds, glm::vec3(toWorld * glm::vec4(mesh.positions[k], 1)));
        const float distance = distanceTo(bounds, eye);
        if (distance < nearest && mayBeVisible(bounds, toClip))
            nearest = distance;
    }
    return nearest;
}

float nearestInSight(const RenderScene& scene, const glm::mat4& toClip, glm::vec3 eye) {
    float nearest = std::numeric_limits<float>::infinity();
    for (const GpuInstance& instance : scene.instances) {
        if (distanceTo(instance.bounds, eye) >= nearest || !mayBeVisible(instance.bounds, toClip))
            continue;
        const Mesh& mesh = scene.assets->meshes[instance.mesh];
        const std::vector<Bounds>& chunks = scene.meshes[instance.mesh].chunks;
        for (std::size_t i = 0; i < chunks.size(); ++i) {
            const Bounds bounds = transformBounds(chunks[i], instance.toWorld);
            if (distanceTo(bounds, eye) < nearest && mayBeVisible(bounds, toClip))
                nearest = nearestTriangle(mesh, instance.toWorld, i * kChunkTriangles,
                                          std::min((i + 1) * kChunkTriangles, mesh.triangleCount()),
                                          toClip, eye, nearest);
        }
    }
    return nearest;
}

bool mayBeVisible(const Bounds& bounds, const glm::mat4& toClip) {
    std::uint32_t outsideAll = 63;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) ? bounds.upper.x : bounds.lower.x,
                          (corner & 2) ? bounds.upper.y : bounds.lower.y,
                          (corner & 4) ? bounds.upper.z : bounds.lower.z);
        const glm::vec4 q = toClip * glm::vec4(p, 1);
        const std::uint32_t outside = std::uint32_t(q.x < -q.w) | std::uint32_t(q.x > q.w) << 1 |
                                      std::uint32_t(q.y < -q.w) << 2 |
                                      std::uint32_t(q.y > q.w) << 3 | std::uint32_t(q.z < 0) << 4 |
                                      std::uint32_t(q.z > q.w) << 5;
        outsideAll &= outside;
    }
    return outsideAll == 0;
}

} // namespace limn::render
