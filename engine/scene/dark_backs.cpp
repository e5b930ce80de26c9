// SPDX-License-Identifier: MIT
#include "engine/scene/dark_backs.h"

#include "engine/core/parallel.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <glm/matrix.hpp>

namespace limn {

namespace {

bool mayCloseSpace(const Scene& scene, const Instance& instance) {
    const Material& material = scene.materialOf(instance);
    return !instance.dynamic && !isCutout(material) && !(material.transmission > 0);
}

/// Instances with the same transform.
using Group = std::vector<std::uint32_t>;

/// In the order of their first instances.
std::vector<Group> groupByTransform(const Scene& scene) {
    using Key = std::array<float, 16>;
    std::map<Key, std::size_t> groupOf;
    std::vector<Group> groups;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const double volume = glm::determinant(glm::dmat3(glm::dmat4(instance.toWorld)));
        if (!mayCloseSpace(scene, instance) || volume == 0 || !std::isfinite(volume))
            continue;
        Key key;
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r)
                key[std::size_t(4 * c + r)] = instance.toWorld[c][r];
        const auto [place, isNew] = groupOf.try_emplace(key, groups.size());
        if (isNew)
            groups.emplace_back();
        groups[place->second].push_back(i);
    }
    return groups;
}

std::vector<std::uint32_t> meshesOf(const Scene& scene, const Group& group) {
    std::vector<std::uint32_t> meshes;
    for (const std::uint32_t i : group)
        meshes.push_back(scene.instances[i].mesh);
    return meshes;
}

/// Finds the closed surfaces of each distinct list of meshes.
std::map<std::vector<std::uint32_t>, std::vector<ClosedSurface>>
surfacesOfMeshes(const Scene& scene, const std::vector<Group>& groups) {
    std::map<std::vector<std::uint32_t>, std::vector<ClosedSurface>> surfaces;
    for (const Group& group : groups)
        surfaces.try_emplace(meshesOf(scene, group));
    std::vector<std::pair<const std::vector<std::uint32_t>, std::vector<ClosedSurface>>*> all;
    for (auto& entry : surfaces)
        all.push_back(&entry);
    parallelRanges(all.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            std::vector<const Mesh*> meshes;
            for (const std::uint32_t m : all[k]->first)
                meshes.push_back(&scene.assets->meshes[m]);
            all[k]->second = findClosedSurfaces(meshes);
        }
    });
    return surfaces;
}

glm::vec3 middleOf(const Scene& scene, const Instance& instance) {
    const Bounds bounds = boundsOf(scene.meshOf(instance).positions);
    return instance.toWorld * glm::vec4(isEmpty(bounds) ? glm::vec3(0) : bounds.centre(), 1);
}

/// Whether some of the instance's triangles, evenly spread over its list, have their middles behind
/// the surface.
bool reachesBehind(const Scene& scene, const Instance& instance, const PlacedSurface& placed) {
    constexpr std::size_t kLooks = 64;
    const Mesh& mesh = scene.meshOf(instance);
    const std::size_t looks = std::min(kLooks, mesh.triangleCount());
    for (std::size_t i = 0; i < looks; ++i) {
        const std::size_t t = i * mesh.triangleCount() / looks;
        const glm::vec3 middle = trianglePoint(mesh, t, glm::vec2(1 / 3.f));
        if (placed.isBehind(glm::dvec3(glm::vec3(instance.toWorld * glm::vec4(middle, 1)))))
            return true;
    }
    return false;
}

bool isBlack(const Sky& sky) {
    return std::ranges::all_of(skyCellRadiance(sky),
                               [](glm::vec3 radiance) { return radiance == glm::vec3(0); });
}

/// Whether the sky or a light shines behind the surface.
bool isShoneOnBehind(const Scene& scene, const PlacedSurface& placed) {
    const bool room = placed.surface.isRoom();
    if (room && !isBlack(scene.sky))
        return true;
    return std::ranges::any_of(scene.lights, [&](const Light& light) {
        return light.kind == LightKind::Directional ? room
                                                    : placed.isBehind(glm::dvec3(light.position));
    });
}

/// Where the scene is seen from: by its cameras or, where it has none, by that of chooseCamera().
std::vector<glm::dvec3> eyesOf(const Scene& scene) {
    std::vector<glm::dvec3> eyes;
    for (const Camera& camera : scene.cameras)
        eyes.emplace_back(camera.eye);
    if (eyes.empty())
        eyes.emplace_back(chooseCamera(scene, std::nullopt).eye);
    return eyes;
}

} // namespace

bool PlacedSurface::isBehind(glm::dvec3 world) const {
    return limn::isBehind(meshes, surface, glm::dvec3(toObject * glm::dvec4(world, 1)));
}

std::vector<PlacedSurface> findClosedSurfaces(const Scene& scene) {
    const std::vector<Group> groups = groupByTransform(scene);
    const auto surfaces = surfacesOfMeshes(scene, groups);
    std::vector<PlacedSurface> placed;
    for (const Group& group : groups) {
        const glm::dmat4 toWorld(scene.instances[group[0]].toWorld);
        std::vector<const Mesh*> meshes;
        for (const std::uint32_t i : group)
            meshes.push_back(&scene.meshOf(scene.instances[i]));
        for (const ClosedSurface& surface : surfaces.at(meshesOf(scene, group)))
            placed.push_back({group, meshes, surface, glm::inverse(toWorld)});
    }
    return placed;
}

bool isLitBehind(const Scene& scene, const PlacedSurface& placed) {
    if (isShoneOnBehind(scene, placed))
        return true;
    std::vector<bool> bounding(scene.instances.size());
    for (const ShellTriangle t : placed.surface.shell)
        bounding[placed.instances[t.mesh]] = true;
    return std::ranges::any_of(scene.instances, [&](const Instance& instance) {
        if (instance.dynamic && placed.isBehind(glm::dvec3(middleOf(scene, instance))))
            return true;
        const bool bounds = bounding[std::size_t(&instance - scene.instances.data())];
        return emits(scene.materialOf(instance)) &&
               (bounds ? isTwoSided(scene.materialOf(instance))
                       : reachesBehind(scene, instance, placed));
    });
}

void leaveOutDarkBacks(Scene& scene) {
    const std::vector<PlacedSurface> surfaces = findClosedSurfaces(scene);
    const std::vector<glm::dvec3> eyes = eyesOf(scene);
    std::vector<char> dark(surfaces.size());
    parallelRanges(surfaces.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const bool seen = std::ranges::any_of(
                eyes, [&](glm::dvec3 eye) { return surfaces[k].isBehind(eye); });
            dark[k] = seen || isLitBehind(scene, surfaces[k]) ? 0 : 1;
        }
    });
    std::vector<double> behind(scene.instances.size()); // area that faces the dark
    for (std::size_t k = 0; k < surfaces.size(); ++k)
        for (const ShellTriangle t : surfaces[k].surface.shell)
            if (dark[k] != 0)
                behind[surfaces[k].instances[t.mesh]] +=
                    double(triangleArea(*surfaces[k].meshes[t.mesh], t.triangle));
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshOf(instance);
        double all = 0;
        for (std::size_t t = 0; t < mesh.triangleCount() && behind[i] > 0; ++t)
            all += double(triangleArea(mesh, t));
        instance.darkBacks = behind[i] > 0 && behind[i] >= all * (1 - 1e-6) &&
                             isTwoSided(scene.materialOf(instance));
    }
}

} // namespace limn
