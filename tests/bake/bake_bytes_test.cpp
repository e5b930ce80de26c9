// SPDX-License-Identifier: MIT
#include "engine/bake/bake_bytes.h"

#include "engine/bake/link_storage.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

namespace limn {
namespace {

using namespace simple;

/// A closed room, or one with a block that hides some of its floor.
Scene room(bool block) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    if (block)
        b.add(box(glm::vec3(1, -1, 1), glm::vec3(3, 1, 3), false));
    Scene scene = b.build();
    scene.bake.surfels = 2000;
    scene.bake.lightmapCaches = 500;
    scene.bake.rays = 512;
    scene.bake.links = 24;
    scene.bake.grid = {3, 2, 3};
    return scene;
}

Bake bakeOf(const Scene& scene) {
    Result<Bake> baked = bake(TraceScene(scene));
    EXPECT_TRUE(baked) << (baked ? "" : baked.error().message);
    return baked ? std::move(*baked) : Bake{};
}

TEST(BakeBytes, ArePredictedToTheByteWhereEveryCacheHasAllItsLinks) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (const std::uint32_t bands : {2U, 5U}) {
            Scene scene = room(false);
            scene.bake.cut = CutCriterion::SolidAngle;
            scene.bake.storage = storage;
            scene.bake.bands = bands;
            const Bake baked = bakeOf(scene);
            ASSERT_EQ(baked.counts.invalidCaches, 0U);
            const BakeBytes is = bytesOf(baked),
                            predicted = predictBytes(baked.settings, baked.surfels.size(),
                                                     baked.caches.size());
            EXPECT_EQ(is.surfels, predicted.surfels);
            EXPECT_EQ(is.clusters, predicted.clusters);
            EXPECT_EQ(is.links, predicted.links);
            EXPECT_EQ(is.caches, predicted.caches);
        }
}

TEST(BakeBytes, ArePredictedFromAboveWhereCachesLieInWalls) {
    const Scene scene = room(true);
    const Bake baked = bakeOf(scene);
    ASSERT_GT(baked.counts.invalidCaches, 0U);
    const BakeBytes is = bytesOf(baked),
                    predicted =
                        predictBytes(baked.settings, baked.surfels.size(), baked.caches.size());
    EXPECT_LT(is.links, predicted.links);
    const double valid = 1 - double(baked.counts.invalidCaches) / double(baked.caches.size());
    EXPECT_GT(double(is.links), 0.95 * valid * double(predicted.links));
    EXPECT_GT(is.caches, predicted.caches);
    EXPECT_LE(is.caches, predicted.caches + 32 * baked.counts.invalidCaches);
}

TEST(BakeBytes, OfTheOtherStorageAreWhatItTakesInThatStorage) {
    Scene scene = room(true);
    const Bake cones = bakeOf(scene);
    scene.bake.storage = LinkStorage::Sh;
    scene.bake.bands = 4;
    const Bake harmonics = bakeOf(scene);
    EXPECT_EQ(bytesOf(cones, LinkStorage::Sh, 4).total(), bytesOf(harmonics).total());
    EXPECT_EQ(bytesOf(harmonics, LinkStorage::Rtp, 3).total(), bytesOf(cones).total());
    EXPECT_EQ(bytesPerLink(LinkStorage::Rtp, 4), 12U);
    EXPECT_EQ(bytesPerLink(LinkStorage::Sh, 4), 36U);
}

TEST(BakeBytes, TheNumberOfCachesIsExpectedFromTheScene) {
    for (const float texelsPerMetre : {0.f, 4.f}) {
        Scene scene = room(false);
        scene.bake.texelsPerMetre = texelsPerMetre;
        scene.bake.lightmapCaches = texelsPerMetre > 0 ? 0 : 500;
        const auto caches = double(bakeOf(scene).caches.size());
        EXPECT_NEAR(double(expectedCaches(scene)), caches, 0.15 * caches) << texelsPerMetre;
    }
    Scene scene = room(false);
    scene.bake.grid = glm::uvec3(0);
    EXPECT_EQ(expectedCaches(scene), 500U + 500U / 20U); // no grid where all have a lightmap
    scene.instances[0].dynamic = true;
    EXPECT_GT(expectedCaches(scene), 1000U);
}

} // namespace
} // namespace limn
