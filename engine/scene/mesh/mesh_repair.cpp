// SPDX-License-Identifier: MIT
#include "engine/scene/mesh/mesh_repair.h"

#include "engine/scene/reach.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

/// Twice the triangle's area along its normal, in double: floats lose needles far from the origin.
static glm::dvec3 areaVector(const Mesh& mesh, std::size_t t) {
    const auto [a, b, c] = mesh.triangle(t);
    const glm::dvec3 p(mesh.positions[a]);
    return glm::cross(glm::dvec3(mesh.positions[b]) - p, glm::dvec3(mesh.positions[c]) - p);
}

/// Whether the corners are collinear up to rounding of their coordinates, or the area is too small
/// for a float.
static bool hasNoArea(const Mesh& mesh, std::size_t t) {
    const auto [a, b, c] = mesh.triangle(t);
    if (a == b || b == c || c == a)
        return true;
    const glm::vec3 p = mesh.positions[a], q = mesh.positions[b], r = mesh.positions[c];
    const double longest = std::max(
        {double(glm::distance(p, q)), double(glm::distance(q, r)), double(glm::distance(r, p))});
    const double twice = glm::length(areaVector(mesh, t));
    return !(twice > 1e-8 * longest * longest) || twice < double(std::numeric_limits<float>::min());
}

template <class T>
static void gather(std::vector<T>& values, const std::vector<std::uint32_t>& from) {
    if (values.empty())
        return;
    std::vector<T> kept(from.size());
    for (std::size_t i = 0; i < from.size(); ++i)
        kept[i] = values[from[i]];
    values = std::move(kept);
}

static void dropUnusedVertices(Mesh& mesh) {
    constexpr std::uint32_t kUnused = ~0u;
    std::vector<std::uint32_t> renamed(mesh.positions.size(), kUnused);
    for (const std::uint32_t i : mesh.indices)
        renamed[i] = 0;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < renamed.size(); ++i)
        if (renamed[i] != kUnused) {
            renamed[i] = std::uint32_t(kept.size());
            kept.push_back(i);
        }
    if (kept.size() == mesh.positions.size())
        return;
    for (std::uint32_t& i : mesh.indices)
        i = renamed[i];
    gather(mesh.positions, kept);
    gather(mesh.normals, kept);
    gather(mesh.tangents, kept);
    gather(mesh.uv0, kept);
    gather(mesh.uv1, kept);
    for (std::vector<glm::vec2>& uv : mesh.furtherUv)
        gather(uv, kept);
    gather(mesh.colors, kept);
}

RemovedTriangles removeBadTriangles(Mesh& mesh) {
    RemovedTriangles removed;
    std::size_t out = 0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const auto [a, b, c] = mesh.triangle(t);
        if (!withinReach(mesh.positions[a]) || !withinReach(mesh.positions[b]) ||
            !withinReach(mesh.positions[c])) {
            ++removed.notFinite;
        } else if (hasNoArea(mesh, t)) {
            ++removed.zeroArea;
        } else {
            mesh.indices[out++] = a;
            mesh.indices[out++] = b;
            mesh.indices[out++] = c;
        }
    }
    mesh.indices.resize(out);
    dropUnusedVertices(mesh);
    return removed;
}

void generateFlatNormals(Mesh& mesh) {
    constexpr std::uint32_t kNone = ~0u;
    constexpr double kSamePlane = 1 - 1e-7; // cosine; 0.03 degrees
    // Copies of source vertex i form a chain from first[i] through next[].
    std::vector<std::uint32_t> first(mesh.positions.size(), kNone), next, source;
    std::vector<glm::vec3> normals;
    std::vector<std::uint32_t> indices(mesh.indices.size());
    for (std::size_t k = 0; k < mesh.indices.size(); ++k) {
        const glm::dvec3 n = glm::normalize(areaVector(mesh, k / 3));
        std::uint32_t copy = first[mesh.indices[k]];
        while (copy != kNone && glm::dot(glm::dvec3(normals[copy]), n) < kSamePlane)
            copy = next[copy];
        if (copy == kNone) {
            copy = std::uint32_t(source.size());
            source.push_back(mesh.indices[k]);
            normals.emplace_back(n);
            next.push_back(std::exchange(first[mesh.indices[k]], copy));
        }
        indices[k] = copy;
    }
    mesh.indices = std::move(indices);
    gather(mesh.positions, source);
    gather(mesh.tangents, source);
    gather(mesh.uv0, source);
    gather(mesh.uv1, source);
    for (std::vector<glm::vec2>& uv : mesh.furtherUv)
        gather(uv, source);
    gather(mesh.colors, source);
    mesh.normals = std::move(normals);
}

std::size_t mendNormals(Mesh& mesh) {
    std::vector<bool> missing(mesh.normals.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        const glm::dvec3 n(mesh.normals[i]);
        const double length = glm::length(n);
        missing[i] = !(length > 1e-6 && length < 1e6); // true for NaN
        if (missing[i])
            ++count;
        else
            mesh.normals[i] = glm::vec3(n / length);
    }
    if (count == 0)
        return 0;
    std::vector<glm::dvec3> sum(mesh.positions.size(), glm::dvec3(0));
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const glm::dvec3 area = areaVector(mesh, t);
        for (const std::uint32_t corner : mesh.triangle(t))
            sum[corner] += area;
    }
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
        for (const std::uint32_t corner : mesh.triangle(t))
            if (missing[corner]) {
                // Opposite triangles may cancel; any of their normals is used then.
                const double length = glm::length(sum[corner]);
                const glm::dvec3 n = length > 0 ? sum[corner] : areaVector(mesh, t);
                mesh.normals[corner] = glm::vec3(glm::normalize(n));
                missing[corner] = length > 0 ? missing[corner] : false;
            }
    return count;
}

static glm::vec3 perpendicular(glm::vec3 n) {
    const glm::vec3 axis = std::abs(n.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(glm::cross(n, axis));
}

void generateTangents(Mesh& mesh, std::uint32_t uvSet) {
    const std::vector<glm::vec2>& uv = mesh.uv(uvSet);
    std::vector<glm::vec3> alongU(mesh.positions.size(), glm::vec3(0)), alongV = alongU;
    for (std::size_t t = 0; !uv.empty() && t < mesh.triangleCount(); ++t) {
        const auto [a, b, c] = mesh.triangle(t);
        const glm::vec3 e1 = mesh.positions[b] - mesh.positions[a];
        const glm::vec3 e2 = mesh.positions[c] - mesh.positions[a];
        const glm::vec2 d1 = uv[b] - uv[a], d2 = uv[c] - uv[a];
        // Gradient times the UV area: corners are weighted by the amount of texture they carry.
        const float sign = d1.x * d2.y - d1.y * d2.x < 0 ? -1.f : 1.f;
        for (const std::uint32_t i : {a, b, c}) {
            alongU[i] += sign * (e1 * d2.y - e2 * d1.y);
            alongV[i] += sign * (e2 * d1.x - e1 * d2.x);
        }
    }
    mesh.tangents.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 n = mesh.normals[i];
        glm::vec3 tangent = alongU[i] - n * glm::dot(n, alongU[i]);
        const float length = glm::length(tangent);
        tangent = length > 1e-20f && std::isfinite(length) ? tangent / length : perpendicular(n);
        // v points down in glTF, the bitangent up: cross(n, t) * w runs against the gradient of v.
        const float w = glm::dot(glm::cross(n, tangent), alongV[i]) > 0 ? -1.f : 1.f;
        mesh.tangents[i] = glm::vec4(tangent, w);
    }
}

} // namespace limn
