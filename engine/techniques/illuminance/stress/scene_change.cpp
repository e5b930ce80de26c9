// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/stress/scene_change.h"

#include "engine/gallery/random_stream.h"
#include "engine/scene/light/rectangle_light.h"
#include "engine/scene/origin.h"

#include <cmath>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace limn {

static void setBounds(Scene& scene) {
    Bounds all = kNoBounds;
    for (const Instance& i : scene.instances)
        for (const glm::vec3 p : scene.meshOf(i).positions)
            extend(all, glm::vec3(i.toWorld * glm::vec4(p, 1)));
    scene.bounds = isEmpty(all) ? Bounds{} : all;
}

Scene scaledScene(Scene scene, float s) {
    for (Instance& i : scene.instances) {
        for (int c = 0; c < 4; ++c)
            i.toWorld[c] = glm::vec4(glm::vec3(i.toWorld[c]) * s, i.toWorld[c].w);
        i.normalToWorld *= s * s;
    }
    for (Light& l : scene.lights) {
        l.position *= s;
        l.range *= s;
        l.size *= s;
        if (l.kind == LightKind::Point || l.kind == LightKind::Spot)
            l.strength *= s * s; // the same irradiance from s times as far
    }
    scene.bake.texelsPerMetre /= s;
    setBounds(scene);
    return scene;
}

Scene movedScene(Scene scene, glm::vec3 offset) {
    for (Instance& i : scene.instances)
        i.toWorld[3] += glm::vec4(offset, 0);
    for (Light& l : scene.lights)
        l.position += offset;
    setBounds(scene);
    return scene;
}

Document movedDocument(Document document, std::span<const Mesh> meshes, const glm::dvec3& offset) {
    const glm::dvec3 before = document.origin;
    for (auto& [id, object] : document.objects)
        if (Node* node = std::get_if<Node>(&object); node && node->parent == 0)
            node->transform.translation += offset;
    document.origin = originOf(document, meshes);
    for (auto& [id, object] : document.objects)
        if (Light* light = std::get_if<Light>(&object))
            light->position = toWorld(document.origin, toFile(before, light->position) + offset);
    return document;
}

/// The roll is measured from the horizon, so it is recomputed from the rotated width.
static void turnLight(Light& l, const glm::mat3& rotation) {
    const glm::vec3 width = rotation * lightRectangle(l).halfWidth;
    l.position = rotation * l.position;
    l.direction = glm::normalize(rotation * l.direction);
    l.roll = rollTowards(l, width);
}

Scene turnedScene(Scene scene, const glm::mat3& rotation) {
    for (Instance& i : scene.instances) {
        i.toWorld = glm::mat4(rotation) * i.toWorld;
        i.normalToWorld = rotation * i.normalToWorld;
    }
    for (Light& l : scene.lights)
        turnLight(l, rotation);
    setBounds(scene);
    return scene;
}

static std::vector<std::uint32_t> shuffled(std::size_t count, RandomStream& random) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t k = count; k > 1; --k)
        std::swap(order[k - 1], order[random.bits() % k]);
    return order;
}

Scene withTrianglesShuffled(Scene scene, std::uint64_t seed) {
    RandomStream random(seed);
    auto assets = std::make_shared<Assets>(*scene.assets);
    for (Mesh& mesh : assets->meshes) {
        std::vector<std::uint32_t> indices;
        for (const std::uint32_t t : shuffled(mesh.triangleCount(), random))
            for (const std::uint32_t i : mesh.triangle(t))
                indices.push_back(i);
        mesh.indices = std::move(indices);
    }
    scene.assets = std::move(assets);
    return scene;
}

Scene withObjectsShuffled(Scene scene, std::uint64_t seed) {
    RandomStream random(seed);
    std::vector<Instance> instances;
    for (const std::uint32_t i : shuffled(scene.instances.size(), random))
        instances.push_back(scene.instances[i]);
    scene.instances = std::move(instances);
    return scene;
}

bool isEven(const Sky& sky) {
    return sky.kind == SkyKind::Color ||
           (sky.kind == SkyKind::Gradient && sky.radiance == sky.horizon &&
            sky.radiance == sky.ground);
}

} // namespace limn
