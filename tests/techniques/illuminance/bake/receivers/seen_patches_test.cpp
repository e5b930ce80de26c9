// SPDX-License-Identifier: MIT
// Surfels of a shelf that passes through the wall of a sealed room: what of it is seen lies inside,
// where no light of the sky is.
#include "engine/gallery/hostile_scene.h"
#include "engine/lightmap/atlas_stage.h"
#include "engine/math/sampling.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/techniques/illuminance/bake/rays/seen_hits.h"
#include "engine/techniques/illuminance/bake/receivers/seen_patches.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace limn::seen_patches_test {
namespace {

using namespace simple;

constexpr std::uint32_t kShelf = 1; ///< its instance

/// Walls look inward, so nothing but the shelf's own convex outside lies in the open.
Scene roomWithShelf(std::uint32_t surfels) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.7f)));
    b.add(box(glm::vec3(0), glm::vec3(4), true));
    b.add(box({-1, 1, 1}, {1, 1.05f, 3}, false));
    Scene scene = b.build();
    scene.bake.surfels = surfels;
    scene.bake.lightmapCaches = 2000;
    return scene;
}

struct Prepared {
    TraceScene trace;
    SurfelSet set;
    OwnerTables owners;
    Atlas atlas;
    CachePoints points;
    Caches caches;
    SeenPatches seen;

    explicit Prepared(const Scene& scene)
        : trace(scene), set(placeSurfels(trace.scene(), scene.bake.surfels)),
          owners(trace.scene(), set) {
        std::uint64_t rays = 0;
        atlas = atlasStage(trace, scene, hashMeshes(scene), {}, nullptr, rays)->atlas;
        caches = placeCaches(scene, atlas, points);
        seen = findSeenPatches(trace, set, owners, atlas, caches, points, 32, {});
    }
};

TEST(SeenPatches, SurfelsStandWhereTheirPatchesAreSeen) {
    for (const std::uint32_t surfels : {400U, 3000U}) {
        Prepared p(roomWithShelf(surfels));
        const Surfels before = p.set.surfels;
        moveSurfels(p.trace.scene(), p.seen.place, p.set);
        const Surfels& s = p.set.surfels;
        EXPECT_EQ(s.area, before.area);
        std::uint32_t moved = 0, cameIn = 0;
        for (std::uint32_t i = 0; i < s.size(); ++i) {
            if (s.position[i] == before.position[i]) {
                EXPECT_EQ(s.normal[i], before.normal[i]);
                continue;
            }
            ++moved;
            if (s.instance[i] != kShelf)
                continue;
            EXPECT_GT(s.position[i].x, 0) << "seen from within the room only";
            cameIn += before.position[i].x < 0 ? 1 : 0;
        }
        EXPECT_GT(cameIn, 0U) << surfels;
        EXPECT_LT(moved, s.size() / 2) << "most patches are seen as they are";
    }
}

// Caches in the gap meet the patches of its rims more often than the room does.
TEST(SeenPatches, APatchHalfBehindAPlateStandsWhereTheRoomSeesIt) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.7f)));
    b.add(box(glm::vec3(-2), glm::vec3(2), true));
    b.add(box({-1, 1.98f, -1}, {1, 1.9998f, 1}, false));
    Scene scene = b.build();
    scene.bake.surfels = 3000;
    scene.bake.lightmapCaches = 4000;
    Prepared p(scene);
    moveSurfels(p.trace.scene(), p.seen.place, p.set);
    std::uint32_t asked = 0, behind = 0;
    for (int i = 0; i < 2000; ++i) { // beside the plate's edges, within 10 cm of them
        const float along = 2 * radicalInverse(std::uint32_t(i + 1), 3) - 1,
                    off = 1 + 0.1f * radicalInverse(std::uint32_t(i + 1), 2);
        const glm::vec3 from = i % 2 ? glm::vec3(along, 1.9f, off) : glm::vec3(off, 1.9f, along);
        const Hit hit = p.trace.closestHit({from, {0, 1, 0}});
        ASSERT_EQ(hit.instance, 0U);
        const glm::vec3 place =
            p.set.surfels.position[p.owners.surfelAt(0, hit.triangle, hit.u, hit.v, false)];
        ++asked;
        behind += std::max(std::abs(place.x), std::abs(place.z)) < 1;
    }
    // Slivers that no ray met stay. Where all rays counted alike, it was one in ten.
    EXPECT_LT(behind, asked / 40) << behind << " of " << asked;
}

// Texels that were added near a lamp see one side of it. Those that came last are made to be such.
TEST(SeenPatches, TexelsThatWereAddedNearLampsDrawNoSurfelThere) {
    Prepared p(roomWithShelf(3000));
    const std::uint32_t count = p.caches.lightmapCount, kept = count / 2;
    p.points.weight.assign(count, 1);
    std::fill(p.points.weight.begin() + kept, p.points.weight.end(), 1 / 16.f);
    const auto places = [&] {
        return findSeenPatches(p.trace, p.set, p.owners, p.atlas, p.caches, p.points, 32, {}).place;
    };
    const std::vector<MeshPoint> weighted = places();
    EXPECT_NE(weighted, p.seen.place);
    p.caches.lightmapCount = kept; // the others are gone
    EXPECT_EQ(weighted, places());
}

TEST(SeenPatches, TheirPlacesLieOnTheSameSideOfATwoSidedSurface) {
    Scene scene = roomWithShelf(3000);
    scene.materials[0].doubleSided = true;
    Prepared p(scene);
    moveSurfels(scene, p.seen.place, p.set);
    const Surfels& s = p.set.surfels;
    for (std::uint32_t i = 0; i < s.size(); ++i) {
        const std::uint32_t fronts = p.set.meshes[s.instance[i]].frontCount;
        const WorldPoint at =
            worldPoint(scene, scene.instances[s.instance[i]], {s.triangle[i], s.barycentric[i]});
        const bool back = i - p.set.instanceBegin[s.instance[i]] >= fronts;
        EXPECT_GT(glm::dot(at.normal, s.normal[i]) * (back ? -1.f : 1.f), 0.999f);
        EXPECT_LT(glm::length(at.position - s.position[i]), 1e-4f);
    }
}

TEST(SeenPatches, CachesOfTheirOwnTakeTexelsThatNoLookupNeeds) {
    Scene scene = roomWithShelf(3000);
    scene.bake.lightmapCaches = 1000; // so coarse that lookups at the wall read beyond it
    Prepared p(scene);
    const std::uint32_t texels = p.caches.lightmapCount;
    const std::size_t own = p.seen.surfelCaches.size();
    ASSERT_GT(own, 0U);
    EXPECT_LE(own, texels / 20);
    placeSeen(p.trace.scene(), p.seen, p.set);
    Surfels& s = p.set.surfels;
    const Surfels before = s;
    addSurfelCaches(p.trace.scene(), p.atlas.layout, p.seen, s, p.caches, p.points);
    ASSERT_EQ(p.caches.lightmapCount, texels + own);
    const std::set<std::uint32_t> taken(p.caches.texel.begin(), p.caches.texel.end());
    EXPECT_EQ(taken.size(), texels + own) << "each a texel of its own";
    EXPECT_LT(*taken.rbegin(), p.atlas.layout.width * p.atlas.layout.height);
    std::set<std::uint32_t> read;
    for (std::uint32_t i = 0; i < s.size(); ++i) {
        if (p.seen.surfelCache[i] == ~0U) {
            EXPECT_EQ(s.cache[i], before.cache[i]);
            continue;
        }
        EXPECT_EQ(s.cacheWeight[i], glm::vec4(1, 0, 0, 0));
        const std::uint32_t c = s.cache[i].x;
        read.insert(c);
        EXPECT_EQ(s.instance[i], kShelf) << "no other surfel's caches see the sky";
        for (std::uint32_t k = p.points.begin[c]; k < p.points.begin[c + 1]; ++k) {
            EXPECT_GT(p.points.position[k].x, 0);
            EXPECT_GT(glm::dot(p.points.normal[k], s.normal[i]), 0.7f);
        }
    }
    EXPECT_EQ(read.size(), own) << "none without a surfel";
}

/// Share of the irradiance of a bright hemisphere that comes from an instance's directions.
double shareOf(const TraceScene& trace, std::uint32_t instance, glm::vec3 position,
               glm::vec3 normal) {
    constexpr std::uint32_t kRays = 256;
    const DirectionSet directions = gatherDirections(kRays, CacheKind::Hemisphere, 0);
    const std::vector<float> irradiance = rayIrradiances(kRays, CacheKind::Hemisphere);
    const glm::mat3 toWorld = basisAround(normal);
    double share = 0;
    for (std::uint32_t r = 0; r < kRays; ++r)
        if (trace.closestHit({trace.clearOf(position, normal), toWorld * directions[r]}).instance ==
            instance)
            share += double(irradiance[r]);
    return share;
}

/// The mean over a cache's points.
double shareOf(const Prepared& p, std::uint32_t instance, std::uint32_t cache) {
    const std::uint32_t begin = p.points.begin[cache], end = p.points.begin[cache + 1];
    double sum = 0;
    for (std::uint32_t k = begin; k < end; ++k)
        sum += shareOf(p.trace, instance, p.points.position[k], p.points.normal[k]);
    return sum / (end - begin);
}

// A low table stands in a closed room under a ceiling of light. Texels of the floor are much wider
// than surfels, so that those by the table's edge read both what it covers and what it does not.
// Where texels are coarser than objects, surfels of several of them read one cache. A cache of
// their own has its points on one of them.
TEST(SeenPatches, CachesOfTheirOwnAreOfOneInstance) {
    const HostileScene made = hostileScene(20630);
    const Scene scene = flatten(made.document, made.assets);
    const Prepared p(scene);
    ASSERT_GT(p.seen.surfelCaches.size(), 0U);
    const Surfels& s = p.set.surfels;
    for (std::uint32_t i = 0; i < s.size(); ++i)
        if (const std::uint32_t own = p.seen.surfelCache[i]; own != ~0U) {
            const SurfelCache& cache = p.seen.surfelCaches[own];
            EXPECT_EQ(cache.instance, s.instance[i]);
            const Mesh& mesh = scene.meshOf(scene.instances[cache.instance]);
            for (std::uint32_t k = 0; k < cache.count; ++k)
                EXPECT_LT(cache.points[k].triangle, mesh.triangleCount());
        }
}

TEST(SeenPatches, SurfelsWhoseCachesSeeAnotherShareOfLampsReadCachesOfTheirOwn) {
    constexpr std::uint32_t kLamp = 2;
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.7f)));
    b.addMaterial(lambert(glm::vec3(0), glm::vec3(1)));
    b.add(box(glm::vec3(0), glm::vec3(4), true));
    b.add(box({1, 0.3f, 1}, {3, 0.35f, 3}, false));
    b.add(quad({0, 3.99f, 0}, {4, 0, 0}, {0, 0, 4}, 1));
    Scene scene = b.build();
    scene.bake.surfels = 3000;
    scene.bake.lightmapCaches = 150;
    Prepared p(scene);
    const std::uint32_t texels = p.caches.lightmapCount;
    ASSERT_GT(p.seen.surfelCaches.size(), 0U);
    placeSeen(p.trace.scene(), p.seen, p.set);
    Surfels& s = p.set.surfels;
    addSurfelCaches(p.trace.scene(), p.atlas.layout, p.seen, s, p.caches, p.points);
    double before = 0, after = 0;
    for (std::uint32_t i = 0; i < s.size(); ++i) {
        if (p.seen.surfelCache[i] == ~0U)
            continue;
        const double share = shareOf(p.trace, kLamp, s.position[i], s.normal[i]);
        double read = 0;
        for (int k = 0; k < 4; ++k)
            if (p.seen.cacheWeight[i][k] > 0)
                read += double(p.seen.cacheWeight[i][k]) * shareOf(p, kLamp, p.seen.cache[i][k]);
        before += std::abs(share - read);
        after += std::abs(share - shareOf(p, kLamp, texels + p.seen.surfelCache[i]));
    }
    EXPECT_LT(after, before / 2);
    scene.materials[1].emission = glm::vec3(0);
    EXPECT_EQ(Prepared(scene).seen.surfelCaches.size(), 0U);
}

} // namespace
} // namespace limn::seen_patches_test
