// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/overlay/surface_text.h"

#include "engine/lightmap/atlas.h"
#include "engine/math/luminance.h"
#include "engine/math/sh.h"
#include "engine/techniques/illuminance/overlay/link_cut.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

namespace {

using Lines = std::vector<OverlayLine>;

void add(Lines& lines, std::string text) {
    lines.push_back({OverlayLine::Style::Plain, std::move(text)});
}

/// The surfel nearest to the point on the side that was hit; none where the object has none there.
std::optional<std::uint32_t> surfelAt(const Surfels& surfels, const Hit& hit) {
    const glm::vec3 side = hit.frontFace ? hit.geometricNormal : -hit.geometricNormal;
    std::optional<std::uint32_t> nearest;
    float best = std::numeric_limits<float>::max();
    for (std::uint32_t i = 0; i < surfels.size(); ++i) {
        if (surfels.instance[i] != hit.instance || glm::dot(surfels.normal[i], side) <= 0)
            continue;
        const glm::vec3 d = surfels.position[i] - hit.position;
        if (const float square = glm::dot(d, d); square < best)
            nearest = i, best = square;
    }
    return nearest;
}

std::string luxText(const glm::vec4& radiosity) {
    return fmt::format("Sends {:.3g} lux", luminance(glm::vec3(radiosity)));
}

void addCluster(const ClusterTree& tree, std::uint32_t surfel, std::uint32_t depth, Lines& lines) {
    const std::vector<std::uint32_t> cluster = clustersAtDepth(tree, depth);
    std::uint32_t members = 0;
    for (std::uint32_t i = 0; i < tree.surfels; ++i)
        members += cluster[i] == cluster[surfel] ? 1 : 0;
    add(lines, cluster[surfel] < tree.leaves()
                   ? std::string("A cluster of its own")
                   : fmt::format("Cluster {} of {} surfels", cluster[surfel], members));
}

Lines surfelLines(const Bake& bake, const Scene& scene, const OverlayOptions& options,
                  const Hit& hit, const LitBake* lit) {
    const Surfels& s = bake.surfels;
    Lines lines;
    const std::optional<std::uint32_t> surfel = surfelAt(s, hit);
    if (!surfel) {
        add(lines, "No surfel on this side of the object");
        return lines;
    }
    const std::uint32_t i = *surfel;
    const Instance& owner = scene.instances[s.instance[i]];
    add(lines, fmt::format("Surfel {}, {:.3g} m\u00b2", i, s.area[i]));
    switch (options.kind) {
    case Overlay::Surfels: {
        const glm::vec3 albedo =
            surfaceMaterial(scene, owner, s.triangle[i], s.barycentric[i].x, s.barycentric[i].y)
                .albedo;
        add(lines, fmt::format("Albedo {:.2f} {:.2f} {:.2f}", albedo.x, albedo.y, albedo.z));
        break;
    }
    case Overlay::SurfelNormals:
        add(lines, fmt::format("Normal {:+.2f} {:+.2f} {:+.2f}", s.normal[i].x, s.normal[i].y,
                               s.normal[i].z));
        break;
    case Overlay::SurfelOwners:
        add(lines,
            fmt::format("Mesh \"{}\", instance {}", scene.meshOf(owner).name, s.instance[i]));
        break;
    case Overlay::Clusters:
        addCluster(bake.tree, i, options.depth, lines);
        break;
    case Overlay::LitSurfels:
        if (lit)
            add(lines, luxText(lit->radiosity[i]));
        break;
    case Overlay::LitClusters:
        addCluster(bake.tree, i, options.depth, lines);
        if (lit)
            add(lines, luxText(lit->radiosity[clustersAtDepth(bake.tree, options.depth)[i]]));
        break;
    default:
        break;
    }
    return lines;
}

Lines cacheLines(const Bake& bake, const Scene& scene, const Hit& hit, const LitBake* lit) {
    Lines lines;
    const std::optional<std::uint32_t> cache = cacheAt(bake, scene, hit);
    if (!cache) {
        add(lines, "No cache here");
        return lines;
    }
    const Caches& caches = bake.caches;
    const std::uint32_t c = *cache;
    add(lines, fmt::format("Cache {}, {}", c,
                           caches.kind[c] == CacheKind::Grid ? "a cell of the grid"
                                                             : "a texel of the lightmap"));
    if (isValid(caches, c))
        add(lines, fmt::format("{} links", caches.linkBegin[c + 1] - caches.linkBegin[c]));
    else
        add(lines, fmt::format("Invalid: filled from {} caches",
                               caches.fillBegin[c + 1] - caches.fillBegin[c]));
    if (lit && caches.kind[c] == CacheKind::Hemisphere) {
        const auto coefficients = std::size_t(lit->bands) * std::size_t(lit->bands);
        const glm::vec3 e =
            shIrradiance(lit->bands, lit->cacheSh.data() + c * coefficients, caches.normal[c]);
        add(lines, fmt::format("Receives {:.3g} lux", luminance(e)));
    }
    return lines;
}

Lines texelLines(const Bake& bake, const Scene& scene, const Hit& hit) {
    const LightmapLayout& layout = bake.lightmap;
    Lines lines;
    if (hit.instance >= layout.instances.size() || layout.instances[hit.instance].uv.empty()) {
        add(lines, "No lightmap here: lit from the grid");
        return lines;
    }
    const Instance& instance = scene.instances[hit.instance];
    const MeshCharts& charts = layout.meshes[instance.mesh];
    const glm::vec2 size(layout.width, layout.height);
    const glm::vec2 position = lightmapUv(layout, hit.instance, instance.mesh, hit.triangle, hit.u,
                                          hit.v, !hit.frontFace) *
                               size;
    glm::vec3 p[3];
    glm::vec2 uv[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = charts.indices[3 * std::size_t(hit.triangle) + k];
        uv[k] = layout.instances[hit.instance].uv[v] * size;
        p[k] = instance.toWorld *
               glm::vec4(scene.meshOf(instance).positions[charts.sourceVertex[v]], 1);
    }
    const glm::vec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
    const float texels = std::abs(a.x * b.y - a.y * b.x);
    const float area = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    add(lines, fmt::format("Texel {:.0f}, {:.0f} of {} x {}", std::floor(position.x),
                           std::floor(position.y), layout.width, layout.height));
    add(lines, fmt::format("Chart {} of {} of this mesh", charts.chartOfTriangle[hit.triangle] + 1,
                           charts.chartSize.size()));
    if (texels > 0 && area > 0)
        add(lines, fmt::format("{:.3g} texels per metre", std::sqrt(texels / area)));
    return lines;
}

} // namespace

std::vector<OverlayLine> describeSurface(const Bake& bake, const Scene& scene,
                                         const OverlayOptions& options, const Hit& hit,
                                         const LitBake* lit) {
    if (lit && lit->radiosity.size() != bake.tree.size())
        lit = nullptr;
    switch (options.kind) {
    case Overlay::None:
        return {};
    case Overlay::Surfels:
    case Overlay::SurfelNormals:
    case Overlay::SurfelOwners:
    case Overlay::Clusters:
    case Overlay::LitSurfels:
    case Overlay::LitClusters:
        return surfelLines(bake, scene, options, hit, lit);
    case Overlay::Links:
    case Overlay::Caches:
    case Overlay::Dependencies:
    case Overlay::Lobes:
        return cacheLines(bake, scene, hit, lit);
    case Overlay::Charts:
    case Overlay::Density:
    case Overlay::Overlap:
        return texelLines(bake, scene, hit);
    }
    return {};
}

} // namespace limn
