// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_backs.h"

#include "engine/core/hash.h"
#include "engine/scene/mesh/mesh_repair.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <tuple>

#include <glm/geometric.hpp>

namespace limn {

namespace {

/// A triangle of one of the meshes of a part.
struct PlacedTriangle {
    std::uint64_t place = 0;                ///< a hash of where its corners lie, in whatever order
    std::uint32_t member = 0, triangle = 0; ///< of the part
};

/// Triangles in one place beyond which none is paired: files do not have as many.
constexpr std::size_t kMaxStacked = 64;

/// Where a triangle's corners lie, beginning with the smallest.
using Corners = std::array<glm::vec3, 3>;

bool lessThan(glm::vec3 a, glm::vec3 b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// The corner, 0 to 2, that lies first.
std::size_t firstCorner(const Corners& c) {
    std::size_t first = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (lessThan(c[k], c[first]))
            first = k;
    return first;
}

Corners cornersOf(const Mesh& mesh, std::uint32_t triangle) {
    Corners c;
    for (std::size_t k = 0; k < 3; ++k)
        c[k] = mesh.positions[mesh.indices[3 * triangle + k]] + 0.f; // -0 becomes 0
    return c;
}

std::uint64_t placeOf(const Corners& c) {
    std::uint64_t sum = 0;
    for (const glm::vec3& corner : c)
        sum += hashBytes(&corner, sizeof corner);
    return sum;
}

/// Vertices of the corners, beginning with the first, in the triangle's order or against it.
std::array<std::uint32_t, 3> orderedVertices(const Mesh& mesh, std::uint32_t triangle,
                                             bool reversed) {
    const auto first = std::uint32_t(firstCorner(cornersOf(mesh, triangle)));
    const std::uint32_t step = reversed ? 2 : 1;
    std::array<std::uint32_t, 3> result{};
    for (std::uint32_t k = 0; k < 3; ++k)
        result[k] = mesh.indices[3 * triangle + (first + step * k) % 3];
    return result;
}

/// Whether b is the back of a.
bool isBackOf(const Mesh& a, std::uint32_t ofA, const Mesh& b, std::uint32_t ofB) {
    constexpr float kSame = 1e-5f;
    const std::array front = orderedVertices(a, ofA, false), back = orderedVertices(b, ofB, true);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t i = front[k], j = back[k];
        if (a.positions[i] != b.positions[j] ||
            !(glm::dot(a.normals[i], b.normals[j]) < -1 + 1e-3f))
            return false;
        if (a.uv0.empty() != b.uv0.empty() || a.colors.empty() != b.colors.empty())
            return false;
        if (!a.uv0.empty() && glm::distance(a.uv0[i], b.uv0[j]) > kSame)
            return false;
        if (!a.colors.empty() && glm::distance(a.colors[i], b.colors[j]) > kSame)
            return false;
    }
    return true;
}

enum class Fate : std::uint8_t { OneSided, TwoSided, Removed };

/// The mesh with those of its triangles that have this fate, without vertices that these lack.
Mesh partWith(const Mesh& mesh, std::span<const Fate> fates, Fate fate) {
    Mesh part = mesh;
    part.indices.clear();
    for (std::size_t t = 0; t < fates.size(); ++t)
        if (fates[t] == fate)
            part.indices.insert(part.indices.end(), mesh.indices.begin() + std::ptrdiff_t(3 * t),
                                mesh.indices.begin() + std::ptrdiff_t(3 * t + 3));
    removeBadTriangles(part);
    return part;
}

/// Pairs triangles that lie in one place, and notes what becomes of them.
std::size_t pairUp(std::span<const PlacedTriangle> stack, std::span<const std::uint32_t> part,
                   const std::vector<Mesh>& meshes, const std::vector<Material>& materials,
                   std::vector<std::vector<Fate>>& fates) {
    std::size_t pairs = 0;
    for (std::size_t i = 1; i < stack.size(); ++i) {
        const Mesh& back = meshes[part[stack[i].member]];
        for (std::size_t k = 0; k < i; ++k) {
            const Mesh& front = meshes[part[stack[k].member]];
            Fate& fate = fates[part[stack[k].member]][stack[k].triangle];
            if (fate != Fate::OneSided ||
                !(materials[front.material] == materials[back.material]) ||
                !isBackOf(front, stack[k].triangle, back, stack[i].triangle))
                continue;
            fate = Fate::TwoSided;
            fates[part[stack[i].member]][stack[i].triangle] = Fate::Removed;
            ++pairs;
            break;
        }
    }
    return pairs;
}

/// Finds pairs among the meshes of a part. `fates`: of the triangles of each mesh.
std::size_t findPairs(std::span<const std::uint32_t> part, const std::vector<Mesh>& meshes,
                      const std::vector<Material>& materials,
                      std::vector<std::vector<Fate>>& fates) {
    std::vector<PlacedTriangle> triangles;
    for (std::uint32_t m = 0; m < part.size(); ++m) {
        const Mesh& mesh = meshes[part[m]];
        fates[part[m]].assign(mesh.triangleCount(), Fate::OneSided);
        for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
            triangles.push_back({placeOf(cornersOf(mesh, t)), m, t});
    }
    std::ranges::sort(triangles, [](const PlacedTriangle& a, const PlacedTriangle& b) {
        return std::tie(a.place, a.member, a.triangle) < std::tie(b.place, b.member, b.triangle);
    });
    std::size_t pairs = 0;
    for (std::size_t begin = 0, end = 0; begin < triangles.size(); begin = end) {
        while (end < triangles.size() && triangles[end].place == triangles[begin].place)
            ++end;
        if (end - begin <= kMaxStacked)
            pairs += pairUp(std::span(triangles).subspan(begin, end - begin), part, meshes,
                            materials, fates);
    }
    return pairs;
}

} // namespace

std::size_t joinBacks(std::span<std::vector<std::uint32_t>> parts, std::vector<Mesh>& meshes,
                      std::vector<Material>& materials) {
    std::vector<std::vector<Fate>> fates(meshes.size());
    std::size_t pairs = 0;
    for (const std::vector<std::uint32_t>& part : parts)
        pairs += findPairs(part, meshes, materials, fates);
    if (pairs == 0)
        return 0;
    std::vector<bool> staysOneSided(materials.size());
    for (std::size_t m = 0; m < fates.size(); ++m)
        if (std::ranges::count(fates[m], Fate::OneSided) > 0)
            staysOneSided[meshes[m].material] = true;
    std::map<std::uint32_t, std::uint32_t> variants;
    const auto twoSided = [&](std::uint32_t material) {
        if (materials[material].doubleSided)
            return material;
        if (!staysOneSided[material]) {
            materials[material].doubleSided = true;
            return material;
        }
        const auto [entry, isNew] = variants.try_emplace(material, std::uint32_t(materials.size()));
        if (isNew) {
            materials.push_back(materials[material]);
            materials.back().name += " (two-sided)";
            materials.back().doubleSided = true;
        }
        return entry->second;
    };
    for (std::vector<std::uint32_t>& part : parts)
        for (std::size_t k = part.size(); k-- > 0;) {
            const std::uint32_t m = part[k];
            const std::vector<Fate>& mine = fates[m];
            const auto paired = std::ranges::count(mine, Fate::TwoSided);
            if (paired == 0 && std::ranges::count(mine, Fate::Removed) == 0)
                continue;
            if (paired > 0 && std::ranges::count(mine, Fate::OneSided) > 0) {
                Mesh divided = partWith(meshes[m], mine, Fate::TwoSided);
                divided.material = twoSided(divided.material);
                part.push_back(std::uint32_t(meshes.size()));
                meshes.push_back(std::move(divided));
                meshes[m] = partWith(meshes[m], mine, Fate::OneSided);
            } else if (paired > 0) {
                meshes[m] = partWith(meshes[m], mine, Fate::TwoSided);
                meshes[m].material = twoSided(meshes[m].material);
            } else {
                meshes[m] = partWith(meshes[m], mine, Fate::OneSided);
            }
            if (meshes[m].indices.empty())
                part.erase(part.begin() + std::ptrdiff_t(k));
        }
    return pairs;
}

} // namespace limn
