// SPDX-License-Identifier: MIT
// What bounces pass on: less than they receive, or they are stopped.
#include "engine/techniques/illuminance/relight/bouncing.h"
#include "tests/techniques/illuminance/bake/house_on_ground.h"
#include "tests/techniques/illuminance/relight/lit_room.h"
#include "tests/techniques/illuminance/relight/relit.h"

#include <cmath>

namespace limn::energy_test {
namespace {

Scene roomOf(float albedo, LinkStorage storage = LinkStorage::Rtp) {
    Scene scene = *litRoom(900, 800);
    scene.materials[0].baseColor = glm::vec4(glm::vec3(albedo), 1);
    scene.bake.rays = 256;
    scene.bake.links = 64;
    scene.bake.storage = storage;
    return scene;
}

/// Every link brings 2^exponent times the light.
std::shared_ptr<const Bake> amplified(Bake baked, int exponent) {
    for (std::int8_t& e : baked.caches.linkExponent)
        e = std::int8_t(e - exponent);
    return std::make_shared<const Bake>(std::move(baked));
}

TEST(Energy, AClosedRoomPassesOnItsAlbedo) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (const float albedo : {0.2f, 0.6f, 0.9f}) {
            const Scene scene = roomOf(albedo, storage);
            const TraceScene trace(scene);
            Relighter relighter(bakeOf(trace));
            EXPECT_EQ(relighter.relight(scene, trace, 2).passedOn, 0) << "not known yet";
            const RelightStats stats = relighter.relight(scene, trace, 400);
            EXPECT_TRUE(stats.converged);
            EXPECT_FALSE(stats.grows);
            EXPECT_NEAR(stats.passedOn, albedo, 0.02 * albedo);
        }
}

TEST(Energy, AnOpenRoomPassesOnLess) {
    Scene scene = roomOf(0.6f);
    auto assets = std::make_shared<Assets>(*scene.assets);
    assets->meshes[0].indices.resize(assets->meshes[0].indices.size() - 6); // a wall
    scene.assets = assets;
    const Relit lit(scene);
    Relighter relighter(lit.baked);
    const double passedOn = relighter.relight(scene, lit.trace, 64).passedOn;
    EXPECT_GT(passedOn, 0.3);
    EXPECT_LT(passedOn, 0.57);
}

TEST(Energy, LightThatGrowsIsStoppedWhileItIsFinite) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        Scene scene = roomOf(0.6f, storage);
        const TraceScene trace(scene);
        const auto baked = bakeOf(trace);
        Relighter relighter(amplified(*baked, 10)); // 600 times as much with every bounce
        const RelightStats stats = relighter.relight(scene, trace, 64);
        EXPECT_TRUE(stats.grows);
        EXPECT_TRUE(stats.converged) << "no more bounces";
        EXPECT_EQ(stats.bounces, 2 + 3) << "600^3 is the first power above kGrown";
        EXPECT_NEAR(stats.passedOn, 1024 * 0.6, 0.05 * 1024 * 0.6);
        for (const glm::vec4 b : relighter.radiosity())
            EXPECT_TRUE(std::isfinite(b.x));
        EXPECT_TRUE(relighter.relight(scene, trace, 64).skipped);

        scene.materials[0].baseColor = glm::vec4(glm::vec3(0.6f / 1024), 1);
        const RelightStats darker = relighter.relight(scene, trace, 400);
        EXPECT_FALSE(darker.grows);
        EXPECT_TRUE(darker.converged);
        EXPECT_NEAR(darker.passedOn, 0.6, 0.02 * 0.6);
    }
}

TEST(Energy, SeenSharesAreThoseOfTheTreeAndSumToAllButTheSky) {
    const Scene scene = roomOf(0.6f);
    const ClusterTree tree = bakeOf(TraceScene(scene))->tree;
    const std::vector<float> shares = seenShares(tree);
    ASSERT_EQ(shares.size(), tree.surfels);
    double sum = 0;
    for (const float share : shares) {
        EXPECT_GE(share, 0);
        sum += double(share);
    }
    EXPECT_NEAR(sum, 1, 0.02); // the room is closed
}

// When rounds ended by the share of all light alone that they changed, the walls of the house were
// 21 % too dark.
TEST(Energy, BouncesInAHouseGoOnBesideAGroundThatIsFarBrighter) {
    Scene scene = houseOnGround(1).build();
    scene.materials[0].baseColor = glm::vec4(glm::vec3(0.8f), 1);
    scene.sky.radiance = glm::vec3(0);
    scene.bake.surfels = 4000;
    scene.bake.lightmapCaches = 3000;
    scene.relight.maxBounces = 64;
    const auto lamp = [&](glm::vec3 position, float candela) {
        Light light;
        light.kind = LightKind::Point;
        light.position = position;
        light.strength = candela;
        scene.lights.push_back(light);
    };
    lamp({3, 1.5f, 2.5f}, 100);
    const TraceScene trace(scene);
    const auto baked = bakeOf(trace);
    const auto wallLight = [&] {
        Relighter relighter(baked);
        relighter.relight(scene, trace, 400);
        double sum = 0;
        const Surfels& s = baked->surfels;
        for (std::size_t i = 0; i < s.size(); ++i)
            sum += s.instance[i] == 1 ? double(relighter.radiosity()[i].x * s.area[i]) : 0;
        return sum;
    };
    const double alone = wallLight();
    lamp({40, 30, 40}, 1e6f);
    EXPECT_NEAR(wallLight() / alone, 1, 0.005);
}

// Each round passes on 0.99, which rounding scatters by 4 %.
TEST(Energy, BouncesDoNotEndByTheFirstShareThatRoundingMakesLow) {
    Convergence convergence;
    double change = 1, missing = 0;
    for (int k = 0; k < 3000 && !convergence.reached(); ++k) {
        const double scatter[] = {1, 1.04, 0.96, 1};
        convergence.addRound({change * scatter[k % 4], 1000, 0});
        change *= 0.99;
        missing = change / 0.01 / 1000;
    }
    EXPECT_TRUE(convergence.reached());
    EXPECT_LT(missing, RelightSettings().tolerance / 100);
}

TEST(Energy, ALittleMoreThanAllIsGrowthAndRoundingIsNot) {
    Convergence steady, growing;
    for (std::uint32_t k = 0; k < 2 + Convergence::kGrowing; ++k) {
        EXPECT_FALSE(growing.grows());
        steady.addRound({1 + 1e-6 * k, 10, 0.5});
        growing.addRound({std::pow(1.01, k), 10, 0.5});
    }
    EXPECT_FALSE(steady.grows());
    EXPECT_FALSE(steady.reached());
    EXPECT_TRUE(growing.grows());
    EXPECT_TRUE(growing.reached());
    growing.lightChanged();
    EXPECT_FALSE(growing.grows());
    EXPECT_FALSE(growing.reached());
    EXPECT_EQ(growing.passedOn(), 0);
}

} // namespace
} // namespace limn::energy_test
