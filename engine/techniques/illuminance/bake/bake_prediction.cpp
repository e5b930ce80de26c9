// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/bake_prediction.h"

#include "engine/field/grid_depth.h"
#include "engine/field/grid_placement.h"
#include "engine/lightmap/atlas_stage.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/techniques/illuminance/bake/cut/refinement_priority.h"
#include "engine/techniques/illuminance/bake/cut/training_light.h"
#include "engine/techniques/illuminance/bake/rays/gather.h"
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"
#include "engine/techniques/illuminance/bake/receivers/seen_patches.h"
#include "engine/techniques/illuminance/bake/senders/cluster_tree.h"
#include "engine/techniques/illuminance/bake/senders/surfels.h"
#include "engine/techniques/illuminance/format/link_storage.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace limn {

namespace {

/// Number of the axes' six directions that are the main direction of some triangle.
std::uint32_t waysFaced(const Mesh& mesh) {
    std::uint32_t faced = 0;
    for (std::size_t t = 0; t < mesh.triangleCount() && faced != 0x3f; ++t) {
        const glm::vec3 n = triangleNormal(mesh, t), a = glm::abs(n);
        const int axis = a.x > a.y ? (a.x > a.z ? 0 : 2) : (a.y > a.z ? 1 : 2);
        faced |= 1U << (2 * axis + (n[axis] < 0 ? 1 : 0));
    }
    return std::uint32_t(std::popcount(faced));
}

/// Estimates of what depends on the rays of a bake, and the sizes that its scene adds.
struct Expected {
    double leaves;           ///< senders that a cache sees
    double links;            ///< of a cache
    double aimed;            ///< aimed rays of a cache that meet their senders
    std::uint64_t triangles; ///< of meshes
    std::uint64_t uv;        ///< of vertices, of all instances
    std::uint64_t meshVertices;
};

/// Number of senders that a cache may aim rays at.
std::uint64_t targetsOf(const Scene& scene) {
    const std::uint64_t surfels = scene.bake.surfels;
    return scene.bake.linker == Linker::Gather
               ? std::min<std::uint64_t>(expectedLampSurfels(scene, scene.bake.surfels),
                                         maxLampsAimed(scene.bake.rays))
               : surfels + kSkyCells;
}

Expected expect(const Scene& scene) {
    const BakeSettings& s = scene.bake;
    Expected e{};
    // Half of the lamps' surfels, or of all, face a cache; some are hidden. Lamps in an open room
    // came to 0.6, those in lampshades and in other rooms to 0.1.
    constexpr double kInSight = 0.4;
    e.aimed = kInSight * double(targetsOf(scene));
    // Several rays meet the same sender, the more so the more there are.
    const double rays = s.rays, senders = 2.2 * std::sqrt(double(s.surfels));
    e.leaves = (s.linker == Linker::Gather ? rays * senders / (rays + senders) : 0) + e.aimed;
    // All caches together have as many links as if each had n_L or, where that is less, one per
    // visible sender. That number varies from cache to cache, which smooths the minimum; caches in
    // walls have none.
    constexpr double kValid = 0.95;
    e.links = kValid * std::pow(std::pow(s.links, -4.) + std::pow(e.leaves, -4.), -0.25);
    for (const Mesh& m : scene.assets->meshes) {
        e.triangles += m.triangleCount();
        e.meshVertices += m.positions.size();
    }
    for (const Instance& i : scene.instances)
        if (!i.dynamic)
            e.uv += scene.meshOf(i).positions.size();
    return e;
}

/// Bytes of MeshCharts and InstanceLightmap.
std::uint64_t chartBytes(const Expected& e) {
    constexpr std::uint64_t kIndex = sizeof(std::uint32_t), kUv = sizeof(glm::vec2);
    return e.triangles * 4 * kIndex + e.meshVertices * (kIndex + kUv) + e.uv * kUv;
}

/// Size of the file, from the mean ratios to which zstd compressed each part of the measured
/// scenes.
std::uint64_t fileBytes(const BakeBytes& b, const Expected& e) {
    return std::uint64_t(0.45 * double(b.surfels) + 0.6 * double(b.clusters) +
                         0.76 * double(b.links + b.caches) + 0.35 * double(chartBytes(e)));
}

/// Maximum over the stages of the memory in use, without the scene itself.
std::uint64_t workingBytes(const BakeSettings& s, const BakePrediction& p, const Expected& e,
                           bool stored) {
    const auto caches = double(p.caches), surfels = double(s.surfels);
    // While texels are placed, there are two copies of the charts and up to five of the texels.
    const double atlas = 2. * double(chartBytes(e)) + 5. * sizeof(AtlasTexel) * caches;
    // Each cache's points and, for one ray in 16, the surfel and the place that it met. Each
    // surfel's share of the tables that assign places to surfels.
    constexpr double kPerPoint = 2 * sizeof(glm::vec3), kPerLook = 24, kPerSurfel = 400;
    const double looks = caches * std::min(s.rays / 16, 32U) * kPerLook,
                 points = caches * AtlasTexel::kMaxPoints * kPerPoint;
    const double before = atlas + points + kPerSurfel * surfels;
    const bool detail = s.cut == CutCriterion::Detail;
    // A room with windows came to 11, a courtyard to 7; others have none.
    constexpr double kSkyHits = 12;
    const double hits = caches * s.rays * sizeof(RawHit),
                 aimed = caches * (e.aimed * sizeof(AimedSample) + kSkyHits * sizeof(SkyHit)),
                 training = detail ? surfels * sizeof(float) *
                                         (2 * TrainingLight::kCount + TracedTraining::kCount)
                                   : 0,
                 priority =
                     detail ? caches * e.leaves * (sizeof(float) + sizeof(Representative)) : 0,
                 links = double(p.bytes.links), packed = links + caches * sizeof(PackedLinks);
    // The priorities of refinements reuse the memory of the looks. A stage is stored as an archive
    // that is then compressed into a string that grows by doubling; so is the bake, part by part.
    const double trace = before + looks + hits + (stored ? 4 : 1) * aimed,
                 cut =
                     before + hits + aimed + training + std::max(looks, priority) + packed + links,
                 written =
                     before + double(p.bytes.total()) + 2 * double(p.bytes.links + p.bytes.caches);
    return std::uint64_t(std::min(std::max({trace, cut, written}), 1e18));
}

} // namespace

static std::uint64_t expectedGrid(const Scene& scene) {
    LightmapLayout layout; // filled only as to which instances have a lightmap
    for (const Instance& i : scene.instances) {
        layout.instances.emplace_back();
        if (!i.dynamic)
            layout.instances.back().uv.emplace_back(0);
    }
    const glm::uvec3 grid = chooseGridSize(scene, layout, scene.bake);
    return std::uint64_t(grid.x) * grid.y * grid.z;
}

/// Share of the texels asked for that light from lamps is expected to add: none to nearly as many
/// in the scenes measured.
static double lampShare(const Scene& scene) {
    return refinesNearLamps(scene) ? 0.25 : 0;
}

std::uint64_t expectedCaches(const Scene& scene) {
    double texels = wantedTexels(scene) * (1 + lampShare(scene));
    texels += texels / kCachesPerSurfelCache;
    return std::uint64_t(std::min(texels, 1e15)) + expectedGrid(scene);
}

std::uint64_t minTexels(const Scene& scene) {
    std::vector<std::uint32_t> ways(scene.assets->meshes.size(), ~0U);
    std::uint64_t sum = 0;
    for (const Instance& i : scene.instances)
        if (!i.dynamic) {
            if (ways[i.mesh] == ~0U)
                ways[i.mesh] = waysFaced(scene.meshOf(i));
            sum += std::uint64_t(ways[i.mesh]) * (isTwoSided(scene, i) ? 2 : 1);
        }
    return sum;
}

BakePrediction predictBake(const Scene& scene, bool stored) {
    const BakeSettings& s = scene.bake;
    BakePrediction p;
    p.caches = expectedCaches(scene);
    p.gridCaches = expectedGrid(scene);
    if (const std::uint64_t required = minTexels(scene); required > s.lightmapCaches) {
        const std::uint64_t more = required - s.lightmapCaches;
        p.minTexels = s.texelsPerMetre > 0 ? 0 : required;
        p.caches = s.texelsPerMetre > 0 ? std::max(p.caches, required) : p.caches + more;
    }
    const Expected e = expect(scene);
    p.bytes = predictBytes(s, s.surfels, p.caches);
    p.leaves = e.leaves;
    p.links = double(p.caches) * e.links;
    p.bytes.links = linkBytes(s, p.caches, e.links);
    p.file = fileBytes(p.bytes, e);
    p.working = workingBytes(s, p, e, stored);
    return p;
}

} // namespace limn
