// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/bake_prediction.h"

#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/link_storage.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

namespace limn::bake_bytes_test {
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

TEST(BakeBytes, LinksAndCachesArePredictedWithinAQuarter) {
    for (const bool block : {false, true})
        for (const std::uint32_t links : {16U, 64U}) {
            Scene scene = room(block);
            scene.bake.lightmapCaches = 2000;
            scene.bake.links = links;
            const BakePrediction p = predictBake(scene);
            const Bake baked = bakeOf(scene);
            const BakeBytes is = bytesOf(baked);
            const auto expectNear = [](std::uint64_t predicted, std::uint64_t real) {
                EXPECT_NEAR(double(predicted), double(real), 0.25 * double(real));
            };
            expectNear(p.caches, baked.caches.size());
            expectNear(p.bytes.links, is.links);
            expectNear(p.bytes.total(), is.total());
            EXPECT_EQ(p.minTexels, 0U);
        }
}

TEST(BakeBytes, ManySmallObjectsNeedMoreTexelsThanAreAskedFor) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(box(glm::vec3(0), glm::vec3(40, 30, 40), true));
    const std::uint32_t cube = b.addMesh(box(glm::vec3(-0.1f), glm::vec3(0.1f), false));
    for (int i = 0; i < 200; ++i) {
        glm::mat4 place(1);
        place[3] = glm::vec4(2 + 3.7f * float(i % 10), 2 + 5 * float(i / 50),
                             2 + 7 * float(i / 10 % 5), 1);
        b.addInstance(cube, place);
    }
    Scene scene = b.build();
    scene.bake.surfels = 2000;
    scene.bake.lightmapCaches = 300;
    scene.bake.rays = 64;
    scene.bake.links = 16;
    EXPECT_EQ(minTexels(scene), 6 * 201U);
    const BakePrediction p = predictBake(scene);
    EXPECT_EQ(p.minTexels, 6 * 201U);
    const auto real = double(bakeOf(scene).caches.size());
    EXPECT_NEAR(double(p.caches), real, 0.05 * real);
    scene.bake.lightmapCaches = 5000;
    EXPECT_EQ(predictBake(scene).minTexels, 0U);
}

TEST(BakeBytes, WorkingMemoryHoldsAtLeastTheArraysOfEveryStage) {
    Scene scene = room(false);
    const BakePrediction few = predictBake(scene);
    const std::uint64_t hits = few.caches * scene.bake.rays * sizeof(std::uint32_t);
    EXPECT_GT(few.working, hits + few.bytes.total());
    scene.bake.rays *= 4;
    EXPECT_GT(predictBake(scene).working, few.working + 3 * hits);
}

} // namespace
} // namespace limn::bake_bytes_test
