// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/measure/link_error.h"

#include "engine/lightmap/atlas_stage.h"
#include "engine/math/sampling.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/bake/senders/patch_sides.h"
#include "engine/techniques/illuminance/relight/caches/cache_light.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

namespace limn::link_error_test {
namespace {

using namespace simple;

/// A room with a block in it, whose surfels shine by chance.
struct BakedRoom {
    static Scene build(LinkStorage storage, std::uint32_t links) {
        SceneBuilder b;
        b.addMaterial(lambert(glm::vec3(0.5f)));
        b.add(box(glm::vec3(0), glm::vec3(2, 2, 3), true));
        b.add(box(glm::vec3(0.6f, 0.2f, 0.6f), glm::vec3(1, 1, 1.2f), false));
        Scene scene = b.build();
        scene.bake.surfels = 800;
        scene.bake.lightmapCaches = 200;
        scene.bake.rays = 256;
        scene.bake.bands = 4;
        scene.bake.grid = {2, 2, 2};
        scene.bake.cut = CutCriterion::SolidAngle;
        scene.bake.links = links;
        scene.bake.storage = storage;
        return scene;
    }

    Scene scene;
    TraceScene trace;
    Bake baked;
    PlacedAtlas placed;
    SurfelSet set;
    OwnerTables owners;
    std::vector<glm::vec4> radiosity;

    BakedRoom(LinkStorage storage, std::uint32_t links)
        : scene(build(storage, links)), trace(scene), baked(*bake(trace)), placed(atlasOf(trace)),
          set(placeSurfels(scene, scene.bake.surfels, placed.surfels)), owners(scene, set),
          radiosity(baked.tree.size()) {
        for (std::uint32_t s = 0; s < baked.tree.leaves(); ++s)
            radiosity[s] = glm::vec4(unitFloat(mixBits(s)));
        pullRadiosity(baked.tree, radiosity);
        owners.part(findPatchSides(trace, set, owners, {}));
    }

    static PlacedAtlas atlasOf(const TraceScene& trace) {
        std::uint64_t rays = 0;
        return *atlasStage(trace, trace.scene(), hashMeshes(trace.scene()), {}, nullptr, rays);
    }

    LinkError measure(CacheKind kind, std::uint32_t multiple) const {
        CachePoints points;
        Caches surface = placeCaches(scene, placed.atlas, points);
        std::uint32_t first = 0;
        if (kind == CacheKind::Grid) {
            points = {};
            points.begin = {0};
            first = baked.caches.lightmapCount;
            addGridCaches(baked.gridSize, baked.gridBounds, surface, points);
        }
        const SightReference reference =
            traceSights(trace, set, owners, baked, kind, points, first, 100, multiple);
        EXPECT_GE(reference.cache.size(), kind == CacheKind::Grid ? 6U : 40U);
        return measureLinks(baked, reference, radiosity);
    }
};

constexpr double kHalfs = 1e-3; // of links of very different size, which share an exponent

TEST(LinkError, OfMeasuredLinksIsNoneAgainstTheirOwnRays) {
    const BakedRoom room(LinkStorage::Sh,
                         4096); // one for each sender in sight: no error of the cut
    const LinkError grid = room.measure(CacheKind::Grid, 1),
                    surface = room.measure(CacheKind::Hemisphere, 1);
    EXPECT_EQ(grid.unlinked, 0);
    EXPECT_EQ(surface.unlinked, 0);
    for (std::size_t l = 0; l < 4; ++l) {
        EXPECT_LT(grid.link[l], kHalfs) << "band " << l;
        EXPECT_LT(grid.lit[l], kHalfs) << "band " << l;
    }
    EXPECT_GT(surface.link[2], 10 * kHalfs) << "they are matched to the irradiance";
    EXPECT_LT(surface.irradiance[0], kHalfs);
    EXPECT_GT(surface.irradiance[2], kHalfs);
}

TEST(LinkError, OfConesIsLargerInEveryBand) {
    const BakedRoom cones(LinkStorage::Rtp, 16), harmonics(LinkStorage::Sh, 16);
    for (const CacheKind kind : {CacheKind::Hemisphere, CacheKind::Grid}) {
        const LinkError a = cones.measure(kind, 16), b = harmonics.measure(kind, 16);
        EXPECT_EQ(a.links, b.links);
        EXPECT_EQ(a.unlinked, b.unlinked);
        for (std::size_t l = 2; l < 4; ++l)
            EXPECT_GT(a.link[l], b.link[l]) << "band " << l;
    }
}

TEST(LinkError, OfMoreRaysIsTheNoiseOfFewer) {
    const BakedRoom room(LinkStorage::Sh, 16);
    const LinkError error = room.measure(CacheKind::Grid, 16);
    EXPECT_GT(error.link[0], 10 * kHalfs);
    EXPECT_LT(error.link[0], 0.3);
    EXPECT_GT(error.lit[0], kHalfs) << "which senders a bake's rays meet is chance";
    EXPECT_LT(error.lit[0], 0.1);
}

} // namespace
} // namespace limn::link_error_test
