// SPDX-License-Identifier: MIT
#include "engine/lint/lint_scene.h"

#include "engine/math/sampling.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/scene/origin.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

static std::string nameOrNumber(const Document& document, ObjectId id) {
    const auto found = document.objects.find(id);
    const std::string name = found == document.objects.end() ? "" : objectName(found->second);
    return name.empty() ? fmt::format("#{}", id) : name;
}

std::string objectPath(const Document& document, ObjectId id) {
    if (id == 0)
        return "";
    std::string path = nameOrNumber(document, id);
    // A tree deeper than this is a cycle, which documents do not have.
    for (int depth = 0; depth < 1000; ++depth) {
        const auto found = document.objects.find(id);
        const Node* node =
            found == document.objects.end() ? nullptr : std::get_if<Node>(&found->second);
        if (!node || node->parent == 0)
            break;
        id = node->parent;
        path = nameOrNumber(document, id) + "/" + path;
    }
    return path;
}

Finding findingAbout(const LintScene& in, const LintRule& rule, ObjectId object,
                     std::string problem, std::string advice) {
    return {&rule,
            rule.severity,
            object,
            objectPath(in.document, object),
            std::move(problem),
            std::move(advice)};
}

glm::dvec3 middleInFile(const Scene& scene, const Instance& instance) {
    const Bounds bounds = boundsOf(scene.meshOf(instance).positions);
    const glm::vec3 middle = isEmpty(bounds) ? glm::vec3(0) : bounds.centre();
    return toFile(scene.origin, glm::vec3(instance.toWorld * glm::vec4(middle, 1)));
}

std::string partText(const Scene& scene, const Instance& instance) {
    const auto ofNode = std::ranges::count(scene.instances, instance.node, &Instance::node);
    return ofNode > 1 ? fmt::format("Material \"{}\"", scene.materialOf(instance).name) : "It";
}

std::vector<MeshUse> meshUses(const Scene& scene) {
    std::vector<MeshUse> uses;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> known;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const double area = worldArea(scene, instance);
        const auto [place, isNew] =
            known.try_emplace({instance.mesh, instance.material}, uses.size());
        if (isNew)
            uses.push_back({i, area, 0});
        MeshUse& use = uses[place->second];
        ++use.count;
        if (area > use.area) {
            use.instance = i;
            use.area = area;
        }
    }
    return uses;
}

void UsesByMaterial::add(const Scene& scene, const MeshUse& use) {
    const auto [place, isNew] = m_uses.try_emplace(scene.instances[use.instance].material, use);
    if (isNew)
        return;
    MeshUse& largest = place->second;
    const std::size_t count = largest.count + use.count;
    if (use.area > largest.area)
        largest = use;
    largest.count = count;
}

std::string othersText(std::size_t count) {
    return count > 1 ? fmt::format(" ({} objects)", count) : "";
}

bool isOpen(const TraceScene& trace, glm::vec3 p, glm::vec3 normal) {
    constexpr std::uint32_t kRays = 32;
    const bool around = normal == glm::vec3(0);
    const DirectionSet directions(kRays, around, 1);
    const glm::mat3 basis = basisAround(around ? glm::vec3(0, 0, 1) : normal);
    std::uint32_t backs = 0;
    for (std::uint32_t k = 0; k < kRays; ++k) {
        const SurfaceHit hit = trace.closestSurface({p, basis * directions[k]});
        backs += hit && !hit.frontFace &&
                 !isTwoSided(trace.scene().materialOf(trace.scene().instances[hit.instance]));
    }
    return backs < kRays * 7 / 16;
}

std::vector<LintPoint> spreadPoints(const LintScene& in, std::size_t count) {
    struct Place {
        std::uint32_t instance, triangle;
    };
    std::vector<Place> places;
    std::vector<double> sums; // of areas
    double sum = 0;
    for (std::uint32_t i = 0; i < in.scene.instances.size(); ++i) {
        const Instance& instance = in.scene.instances[i];
        if (isGlassSheet(in.scene.materialOf(instance)))
            continue;
        const auto triangles = std::uint32_t(in.scene.meshOf(instance).triangleCount());
        for (std::uint32_t t = 0; t < triangles; ++t) {
            sum += double(triangleWorldArea(in.scene, instance, t));
            places.push_back({i, t});
            sums.push_back(sum);
        }
    }
    std::vector<LintPoint> points;
    for (std::uint32_t k = 0; k < count && sum > 0; ++k) {
        const double share = (k + 0.5) / double(count) * sum;
        const auto found = std::ranges::upper_bound(sums, share);
        const Place& place = places[std::min(std::size_t(found - sums.begin()), places.size() - 1)];
        const Instance& instance = in.scene.instances[place.instance];
        const Mesh& mesh = in.scene.meshOf(instance);
        const glm::vec2 uv = sampleTriangle({radicalInverse(k + 1, 2), radicalInverse(k + 1, 3)});
        const glm::vec3 normal = instance.normalToWorld * triangleNormal(mesh, place.triangle);
        if (!(glm::length(normal) > 0))
            continue;
        const bool back = isTwoSided(in.scene, instance) && k % 2 == 1;
        const glm::vec3 n = glm::normalize(normal) * (back ? -1.f : 1.f);
        const glm::vec3 p(instance.toWorld * glm::vec4(trianglePoint(mesh, place.triangle, uv), 1));
        points.push_back({place.instance, in.trace.clearOf(p, n), n});
    }
    return points;
}

} // namespace limn
