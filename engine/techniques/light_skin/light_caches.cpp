// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/light_caches.h"

#include "engine/core/parallel.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/scene/surface/specular.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

std::uint64_t LightCaches::bytes() const {
    std::uint64_t bytes = size() * (2 * sizeof(glm::vec3) + sizeof(float) + sizeof(std::uint32_t)) +
                          instances.size() * sizeof(Placed);
    std::set<const MeshSkin*> counted;
    for (const Placed& placed : instances)
        if (placed.skin && counted.insert(placed.skin.get()).second)
            bytes += placed.skin->bytes();
    return bytes;
}

std::size_t LightCaches::find(const Query& query,
                              std::span<std::uint32_t, NearestCaches::kLength> list) const {
    if (query.instance >= instances.size() || !instances[query.instance].skin)
        return 0;
    const Placed& placed = instances[query.instance];
    const NearestCaches* found = nullptr;
    if (const MeshSkin& skin = *placed.skin; !skin.vertexLists.empty() && query.mesh) {
        const float weight[] = {1 - query.u - query.v, query.u, query.v};
        const auto corner = std::size_t(std::ranges::max_element(weight) - weight);
        found = &skin.vertexLists[query.mesh->triangle(query.triangle)[corner]];
    } else {
        found = skin.find(glm::vec3(placed.toObject * glm::vec4(query.position, 1)),
                          glm::normalize(placed.normalToObject * query.normal));
    }
    if (!found)
        return 0;
    std::size_t count = 0;
    for (; count < list.size() && found->cache[count] != NearestCaches::kNone; ++count)
        list[count] = placed.first + found->cache[count];
    return count;
}

/// The longest axis of the instance, as a share of that of its mesh.
static float scaleOf(const Instance& instance) {
    float scale = 0;
    for (int k = 0; k < 3; ++k)
        scale = std::max(scale, glm::length(glm::vec3(instance.toWorld[k])));
    return scale;
}

const MeshSkins::Extent& MeshSkins::extentOf(const Scene& scene, std::uint32_t number) {
    const auto [place, added] = m_extents.try_emplace(number);
    if (added) {
        Extent& extent = place->second;
        const Mesh& mesh = scene.assets->meshes[number];
        for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
            const std::array<std::uint32_t, 3> k = mesh.triangle(t);
            extent.area += double(triangleArea(mesh, t));
            for (std::size_t i = 0; i < 3; ++i)
                extent.perimeter +=
                    double(glm::distance(mesh.positions[k[i]], mesh.positions[k[(i + 1) % 3]]));
        }
        if (!mesh.positions.empty())
            extent.diagonal = glm::length(boundsOf(mesh.positions).size());
    }
    return place->second;
}

float MeshSkins::diagonalOf(const Scene& scene) {
    float diagonal = glm::length(staticBounds(scene).size());
    for (const Instance& instance : scene.instances)
        if (instance.dynamic)
            diagonal =
                std::max(diagonal, extentOf(scene, instance.mesh).diagonal * scaleOf(instance));
    return diagonal;
}

/// `minimum`, or more where there would be too many cubes or pieces: surfaces meet about area /
/// edge^2 cubes, and each triangle about perimeter / edge of them besides one.
float MeshSkins::spacingOf(const Scene& scene, float minimum) {
    double area = 0, perimeter = 0;
    for (const Instance& instance : scene.instances) {
        const Extent& extent = extentOf(scene, instance.mesh);
        const double scale = double(scaleOf(instance));
        const double sides = isTwoSided(scene.materialOf(instance)) ? 2 : 1;
        area += sides * extent.area * scale * scale;
        perimeter += sides * extent.perimeter * scale;
    }
    const double edge = std::max(std::sqrt(area / kMaxCubes), perimeter / kMaxPieces);
    return std::max(minimum, float(2 * edge));
}

std::optional<MeshSkins::Key> MeshSkins::keyOf(const Scene& scene, const Instance& instance,
                                               const SkinLayout& layout, float spacing) {
    const float scale = scaleOf(instance), distance = spacing / scale;
    if (!(scale > 0) || !(distance > 0) || !std::isfinite(distance))
        return {};
    return Key{instance.mesh, distance, layout.angle, isTwoSided(scene.materialOf(instance)),
               layout.vertexLists};
}

void MeshSkins::makeMissing(const Scene& scene, const SkinLayout& layout, float spacing) {
    Skins used;
    std::vector<Skins::value_type*> missing;
    for (const Instance& instance : scene.instances) {
        const std::optional<Key> key = keyOf(scene, instance, layout, spacing);
        if (!key)
            continue;
        const auto [place, added] = used.try_emplace(*key);
        if (!added)
            continue;
        if (const auto kept = m_skins.find(*key); kept != m_skins.end())
            place->second = kept->second;
        else
            missing.push_back(&*place);
    }
    parallelRanges(missing.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto& [mesh, distance, angle, twoSided, vertexLists] = missing[i]->first;
            missing[i]->second = std::make_shared<const MeshSkin>(
                skinOf(scene.assets->meshes[mesh], {distance, angle}, twoSided, vertexLists));
        }
    });
    m_made = std::uint32_t(missing.size());
    m_skins = std::move(used);
}

LightCaches MeshSkins::place(const Scene& scene, const SkinLayout& layout) {
    if (m_assets != scene.assets) {
        m_skins.clear();
        m_extents.clear();
    }
    m_assets = scene.assets;
    LightCaches caches{.diagonal = diagonalOf(scene)};
    caches.spacing = spacingOf(scene, layout.spacing * caches.diagonal);
    makeMissing(scene, layout, caches.spacing);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        caches.instances.push_back({.first = std::uint32_t(caches.size())});
        const std::optional<Key> key = keyOf(scene, instance, layout, caches.spacing);
        if (!key)
            continue;
        LightCaches::Placed& placed = caches.instances.back();
        placed.skin = m_skins.at(*key);
        placed.toObject = glm::inverse(instance.toWorld);
        placed.normalToObject = glm::transpose(glm::mat3(instance.toWorld));
        for (const MeshCache& cache : placed.skin->caches) {
            const glm::vec3 normal = instance.normalToWorld * cache.normal;
            const float stretch = glm::length(normal); // of an area with that normal
            caches.position.emplace_back(instance.toWorld * glm::vec4(cache.position, 1));
            caches.normal.push_back(stretch > 0 ? normal / stretch : glm::vec3(0, 1, 0));
            caches.area.push_back(cache.area * stretch);
            caches.instance.push_back(i);
        }
    }
    return caches;
}

float glossExponent(float roughness) {
    const float alpha = roughness * roughness;
    return std::clamp((2 / std::max(alpha * alpha, 1e-6f) - 2) / 4, 1.f, 500.f);
}

std::vector<float> glossExponents(const Scene& scene, const LightCaches& caches) {
    std::vector<float> exponents;
    for (std::size_t c = 0; c < caches.size(); ++c) {
        const std::uint32_t i = caches.instance[c];
        const MeshCache& cache = caches.instances[i].skin->caches[c - caches.instances[i].first];
        exponents.push_back(glossExponent(
            surfaceGloss(scene, scene.instances[i], cache.triangle, cache.u, cache.v).roughness));
    }
    return exponents;
}

} // namespace limn
