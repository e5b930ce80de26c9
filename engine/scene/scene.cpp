// SPDX-License-Identifier: MIT
#include "engine/scene/scene.h"

#include "engine/core/parallel.h"
#include "engine/scene/placement.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

static glm::mat3 normalMatrix(const glm::mat4& m) {
    const glm::vec3 x(m[0]), y(m[1]), z(m[2]);
    const glm::mat3 cofactor(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
    return glm::dot(x, cofactor[0]) < 0 ? -cofactor : cofactor;
}

/// Position of each Material object among them, which is its index into Scene::materials.
using MaterialIndices = std::map<ObjectId, std::uint32_t>;

static MaterialIndices materialIndices(const Document& document) {
    MaterialIndices indices;
    for (const auto& [id, object] : document.objects)
        if (std::holds_alternative<Material>(object))
            indices.emplace(id, std::uint32_t(indices.size()));
    return indices;
}

static void addInstances(Scene& scene, const Node& node, ObjectId id, const Placement& placement,
                         const MaterialIndices& materials) {
    for (std::size_t i = 0; i < node.meshes.size(); ++i) {
        const std::uint32_t mesh = node.meshes[i];
        if (mesh >= scene.assets->meshes.size())
            continue; // the scene file lost it since the project was saved
        Instance instance;
        instance.mesh = mesh;
        const auto assigned =
            i < node.materials.size() ? materials.find(node.materials[i]) : materials.end();
        instance.material =
            assigned != materials.end() ? assigned->second : scene.assets->meshes[mesh].material;
        instance.node = id;
        instance.dynamic = placement.dynamic;
        instance.texelDensity = placement.texelDensity;
        instance.toWorld = glm::mat4(placement.toWorld);
        instance.normalToWorld = normalMatrix(instance.toWorld);
        scene.instances.push_back(instance);
    }
}

/// Bounding box of all instances, or of the static ones only.
static Bounds instanceBounds(const Scene& scene, bool dynamic) {
    std::vector<Bounds> each(scene.instances.size(), kNoBounds);
    parallelRanges(scene.instances.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Instance& instance = scene.instances[i];
            if (instance.dynamic && !dynamic)
                continue;
            const glm::mat4x3 toWorld(instance.toWorld);
            for (const glm::vec3& p : scene.meshOf(instance).positions) {
                const glm::vec3 world = toWorld * glm::vec4(p, 1);
                if (!std::isfinite(world.x) || !std::isfinite(world.y) || !std::isfinite(world.z))
                    continue;
                extend(each[i], world);
            }
        }
    });
    Bounds all = kNoBounds;
    for (const Bounds& b : each)
        extend(all, b);
    return isEmpty(all) ? Bounds{} : all;
}

bool isTwoSided(const Scene& scene, const Instance& instance) {
    return isTwoSided(scene.materialOf(instance)) && !instance.darkBacks;
}

bool shines(const Light& l) {
    return l.enabled && l.strength > 0 && (l.color.x > 0 || l.color.y > 0 || l.color.z > 0);
}

bool reaches(const Light& l, const Bounds& bounds) {
    const bool ranged = l.kind == LightKind::Point || l.kind == LightKind::Spot;
    if (!ranged || !(l.range > 0))
        return true;
    return glm::distance(glm::clamp(l.position, bounds.lower, bounds.upper), l.position) < l.range;
}

Bounds staticBounds(const Scene& scene) {
    return instanceBounds(scene, false);
}

bool showTime(Scene& scene, const Document& document, double seconds) {
    bool changed = false;
    std::size_t index = 0;
    for (const auto& [id, object] : document.objects)
        if (const Material* material = std::get_if<Material>(&object)) {
            TextureRef& shown = scene.materials[index++].emissiveTexture;
            const TextureRef wanted = emissiveTextureAt(*material, seconds);
            changed |= shown != wanted;
            shown = wanted;
        }
    return changed;
}

Scene flatten(const Document& document, std::shared_ptr<const Assets> assets, double seconds) {
    Scene scene;
    scene.assets = assets ? std::move(assets) : std::make_shared<const Assets>();
    scene.origin = document.origin;
    Placements placements(document);
    const MaterialIndices materials = materialIndices(document);
    for (const auto& [id, object] : document.objects) {
        if (const Node* node = std::get_if<Node>(&object)) {
            if (node->meshes.empty())
                continue;
            if (const Placement placement = placements.of(id); placement.visible)
                addInstances(scene, *node, id, placement, materials);
        } else if (const Material* material = std::get_if<Material>(&object)) {
            scene.materials.push_back(*material);
        } else if (const Light* light = std::get_if<Light>(&object)) {
            scene.lights.push_back(*light);
        } else if (const Camera* camera = std::get_if<Camera>(&object)) {
            scene.cameras.push_back(*camera);
        }
    }
    const auto named = std::uint32_t(scene.materials.size());
    for (Instance& instance : scene.instances)
        if (instance.material >= named) {
            scene.materials.resize(named + 1);
            instance.material = named;
        }
    showTime(scene, document, seconds);
    scene.sky = singleton<Sky>(document);
    scene.bake = singleton<BakeSettings>(document);
    scene.technique = singleton<TechniqueChoice>(document);
    scene.relight = singleton<RelightSettings>(document);
    scene.bounds = instanceBounds(scene, true);
    return scene;
}

} // namespace limn
