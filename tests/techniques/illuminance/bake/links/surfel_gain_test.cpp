// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/links/surfel_gain.h"

#include "engine/techniques/illuminance/format/link_storage.h"
#include "tests/techniques/illuminance/relight/relit.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

namespace limn::surfel_gain_test {
namespace {

/// Two caches that look up, each with one narrow link, to 60 degrees from the normal, and a third
/// one that copies both.
Caches twoCaches(LinkStorage storage, float transport) {
    const glm::vec3 direction(std::sqrt(0.75f), 0.5f, 0);
    Caches caches;
    caches.lightmapCount = 3;
    caches.position.resize(3);
    caches.normal.assign(3, glm::vec3(0, 1, 0));
    const std::vector<Cone> cones = {{0, direction, 1e-4f, transport, transport / 2}};
    PackedLinks links = packCones(cones);
    if (storage == LinkStorage::Sh) {
        float sh[9];
        shBasis(3, direction, sh);
        for (float& c : sh)
            c *= transport;
        links = packHarmonics(3, {0}, sh);
    }
    joinLinks(std::vector<PackedLinks>{links, links, {}}, caches);
    caches.fillBegin = {0, 0, 0, 2};
    caches.fillSource = {0, 1};
    caches.fillWeight = {0.25f, 0.75f};
    return caches;
}

Surfels surfelsLooking(const std::vector<glm::vec3>& normals, glm::uvec4 cache, glm::vec4 weight) {
    Surfels surfels;
    surfels.position.resize(normals.size());
    surfels.normal = normals;
    surfels.cache.assign(normals.size(), cache);
    surfels.cacheWeight.assign(normals.size(), weight);
    return surfels;
}

// Of a direction at an angle of cosine c, three bands see 1/4 + c/2 + 5/32 (3 c^2 - 1).
double seen(double c) {
    return 0.25 + c / 2 + 5. / 32 * (3 * c * c - 1);
}

TEST(SurfelGain, IsWhatASurfelReadsOfItsCachesWhereAllSendTheSame) {
    const std::vector<glm::vec3> normals = {{0, 1, 0}, {1, 0, 0}, {0, -1, 0}};
    const double cosines[] = {0.5, std::sqrt(0.75), -0.5};
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (const glm::uvec4 cache : {glm::uvec4(0, 1, ~0U, ~0U), glm::uvec4(2, 2, ~0U, ~0U)}) {
            const std::vector<float> gain = furnaceIrradiance(
                surfelsLooking(normals, cache, {0.5f, 0.5f, 0, 0}), twoCaches(storage, 0.8f), 3);
            // Below the caches, whose normal is +Y, the light at a height of 1/2 continues with 5/4
            // - 3/2 times 1/2 of itself over pi (engine/math/horizon.h).
            for (std::size_t k = 0; k < 3; ++k) {
                const double below = 0.5 * (1 - double(normals[k].y)) / 2;
                EXPECT_NEAR(gain[k], 0.8 * (seen(cosines[k]) + below), 1e-3) << k;
            }
        }
}

TEST(SurfelGain, WeightsOfSurfelsThatReadMoreThanOneAreLoweredToOneAndNoOthers) {
    const std::vector<glm::vec3> normals = {{0, 1, 0}, {1, 0, 0}};
    const Caches caches = twoCaches(LinkStorage::Rtp, 1.5f);
    const glm::uvec4 cache(0, 1, 2, ~0U);
    const glm::vec4 weight(0.5f, 0.25f, 0.25f, 0);
    Surfels surfels = surfelsLooking(normals, cache, weight);
    limitGain(caches, 3, surfels);
    EXPECT_EQ(surfels.cacheWeight[0], weight); // 1.5 * 0.461
    EXPECT_NEAR(surfels.cacheWeight[1].x, 0.5 / (1.5 * (seen(std::sqrt(0.75)) + 0.25)), 1e-3);
    EXPECT_NEAR(furnaceIrradiance(surfels, caches, 3)[1], 1, 1e-6);
}

TEST(SurfelGain, SurfelsWithoutCachesReadNothing) {
    Surfels surfels = surfelsLooking({{0, 1, 0}}, glm::uvec4(~0U), glm::vec4(0));
    limitGain(twoCaches(LinkStorage::Rtp, 1.5f), 3, surfels);
    EXPECT_EQ(surfels.cacheWeight[0], glm::vec4(0));
}

// Caches of few texels look another way than the surfels between them.
TEST(SurfelGain, NoSurfelOfABakeReadsMoreThanIsSent) {
    for (const std::uint32_t bands : {2U, 3U, 4U}) {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.5f)));
        b.add(simple::sphere(2, 2, true));
        Scene scene = b.build();
        scene.bake.surfels = 300;
        scene.bake.lightmapCaches = 12;
        scene.bake.rays = 32;
        scene.bake.links = 8;
        scene.bake.bands = bands;
        const auto baked = bakeOf(TraceScene(scene));
        const std::vector<float> gain =
            furnaceIrradiance(baked->surfels, baked->caches, int(bands));
        EXPECT_NEAR(std::ranges::max(gain), 1, 1e-6) << "1.006 before weights were lowered";
    }
}

} // namespace
} // namespace limn::surfel_gain_test
