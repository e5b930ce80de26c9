// SPDX-License-Identifier: MIT
#include "engine/render/near/near_geometry.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/atlas.h"
#include "engine/math/morton.h"
#include "engine/math/packing.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>

namespace limn::render {

using shared::GpuNearNode;
using shared::GpuNearTriangle;

namespace {

constexpr std::size_t kLeafTriangles = 4;
constexpr std::size_t kGrain = 1024; ///< triangles

/// A triangle of an instance.
struct Source {
    std::uint32_t instance, triangle;
};

std::vector<Source> findSources(const Scene& scene, const LightmapLayout& layout) {
    std::vector<Source> sources;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const auto count = std::uint32_t(scene.meshOf(instance).triangleCount());
        if (instance.dynamic || layout.instances[i].uv.empty() ||
            layout.meshes[instance.mesh].indices.size() != 3 * std::size_t(count) ||
            isCutout(scene.materialOf(instance)) || isGlassSheet(scene.materialOf(instance)))
            continue;
        for (std::uint32_t t = 0; t < count; ++t)
            sources.push_back({i, t});
    }
    return sources;
}

std::uint32_t packAlbedo(glm::vec3 albedo, std::uint32_t flags) {
    return (glm::packUnorm4x8(glm::vec4(glm::sqrt(albedo), 0)) & 0xffffffU) | flags << 24;
}

GpuNearTriangle makeTriangle(const Scene& scene, const LightmapLayout& layout, Source s) {
    const Instance& instance = scene.instances[s.instance];
    const Mesh& mesh = scene.meshOf(instance);
    const Material& material = scene.materialOf(instance);
    const std::array<std::uint32_t, 3> corners = mesh.triangle(s.triangle);
    const std::vector<std::uint32_t>& split = layout.meshes[instance.mesh].indices;
    const std::vector<glm::vec2>& uv = layout.instances[s.instance].uv;
    const glm::vec3 object = triangleNormal(mesh, s.triangle),
                    world = instance.normalToWorld * object,
                    front = glm::dot(world, world) > 0 ? glm::normalize(world) : object;
    glm::vec3 p[3];
    std::uint32_t normal[3];
    for (std::size_t k = 0; k < 3; ++k) {
        p[k] = glm::vec3(instance.toWorld * glm::vec4(mesh.positions[corners[k]], 1));
        const glm::vec2 barycentric(k == 1 ? 1 : 0, k == 2 ? 1 : 0);
        normal[k] = packOctWord(shadingNormal(mesh, instance, s.triangle, barycentric, front));
    }
    const auto uvOf = [&](std::size_t k) { return uv[split[3 * s.triangle + k]]; };
    // A mirrored instance has its front on the clockwise side.
    const bool mirrored = glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), front) < 0;
    const std::size_t b = mirrored ? 2 : 1, c = mirrored ? 1 : 2;
    const float area = triangleWorldArea(scene, instance, s.triangle);
    const SurfaceMaterial mean =
        surfaceMaterialOver(scene, instance, s.triangle, 1.f / 3, 1.f / 3, area);
    const std::uint32_t flags = (material.doubleSided ? NEAR_DOUBLE_SIDED : 0U) |
                                (mean.emission != glm::vec3(0) ? NEAR_EMISSIVE : 0U);
    return {.origin = p[0],
            .normal0 = normal[0],
            .edge1 = p[b] - p[0],
            .normal1 = normal[b],
            .edge2 = p[c] - p[0],
            .normal2 = normal[c],
            .uv0 = uvOf(0),
            .uv1 = uvOf(b),
            .uv2 = uvOf(c),
            .albedo = packAlbedo(mean.albedo, flags),
            .backOffset = backOffset(layout, s.instance)};
}

struct Coded {
    std::uint32_t code, triangle;
    auto operator<=>(const Coded&) const = default;
};

std::vector<Coded> alongCurve(const std::vector<GpuNearTriangle>& triangles, const Bounds& bounds) {
    const glm::vec3 size = glm::max(bounds.size(), glm::vec3(1e-30f));
    std::vector<Coded> coded(triangles.size());
    parallelRanges(coded.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const GpuNearTriangle& t = triangles[i];
            const glm::vec3 middle = t.origin + (t.edge1 + t.edge2) / 3.f;
            coded[i] = {mortonCode((middle - bounds.lower) / size), std::uint32_t(i)};
        }
    });
    std::ranges::sort(coded);
    return coded;
}

/// Number of codes in the first part of a range, those in which the highest differing bit is 0.
std::size_t splitOf(std::span<const Coded> range) {
    const std::uint32_t differ = range.front().code ^ range.back().code;
    if (differ == 0)
        return range.size() / 2;
    const std::uint32_t bit = std::bit_floor(differ);
    const auto second =
        std::ranges::partition_point(range, [&](const Coded& c) { return (c.code & bit) == 0; });
    return std::size_t(second - range.begin());
}

Bounds boundsOf(const GpuNearTriangle& t) {
    return limn::boundsOf(std::array{t.origin, t.origin + t.edge1, t.origin + t.edge2});
}

/// Appends the subtree over a range of the curve and returns its bounding box. Its depth is at most
/// 30, plus log2 of the number of triangles that share a code.
Bounds addSubtree(NearGeometry& out, const std::vector<GpuNearTriangle>& triangles,
                  std::span<const Coded> range) {
    const std::size_t node = out.nodes.size();
    out.nodes.emplace_back();
    Bounds bounds = kNoBounds;
    if (range.size() <= kLeafTriangles) {
        out.nodes[node].triangles = std::uint32_t(out.triangles.size() * 8 + range.size());
        for (const Coded& c : range) {
            out.triangles.push_back(triangles[c.triangle]);
            extend(bounds, boundsOf(out.triangles.back()));
        }
    } else {
        const std::size_t split = splitOf(range);
        for (const auto half : {range.first(split), range.subspan(split)})
            extend(bounds, addSubtree(out, triangles, half));
    }
    out.nodes[node].lower = bounds.lower;
    out.nodes[node].upper = bounds.upper;
    out.nodes[node].next = std::uint32_t(out.nodes.size());
    return bounds;
}

} // namespace

NearGeometry nearGeometry(const Scene& scene, const LightmapLayout& layout) {
    NearGeometry out;
    if (layout.instances.size() != scene.instances.size())
        return out;
    const std::vector<Source> sources = findSources(scene, layout);
    if (sources.empty())
        return out;
    std::vector<GpuNearTriangle> triangles(sources.size());
    parallelRanges(sources.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            triangles[i] = makeTriangle(scene, layout, sources[i]);
    });
    out.triangles.reserve(triangles.size());
    out.nodes.reserve(triangles.size());
    addSubtree(out, triangles, alongCurve(triangles, scene.bounds));
    return out;
}

} // namespace limn::render
