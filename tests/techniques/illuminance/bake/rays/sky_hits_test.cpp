// SPDX-License-Identifier: MIT
#include "engine/scene/light/rectangle_light.h"
#include "engine/techniques/illuminance/bake/rays/seen_hits.h"
#include "engine/techniques/illuminance/bake/rays/sky_hits.h"
#include "tests/techniques/illuminance/bake/traced_room.h"
#include "tests/techniques/illuminance/bake/window_room.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

namespace limn::sky_hits_test {
namespace {

using namespace simple;

constexpr float kPi = std::numbers::pi_v<float>;

LightRectangle window(float width) {
    return {{0, 1.5f, 2}, {0, 0, width / 2}, {0, 0.5f, 0}, {1, 0, 0}, width};
}

bool isSky(const TracedRoom& room, std::uint32_t sender) {
    return sender >= room.set.surfels.size() && sender < GatherHits::kFirstMark;
}

SkyHits skyHitsOf(const TracedRoom& room) {
    return findSkyHits({room.trace, room.set.surfels.size(), room.caches, room.points, room.hits,
                        room.lightmap, TracedRoom::kGrid},
                       {});
}

/// Irradiance from a sky of radiosity 1 on each of the room's lightmap caches.
std::vector<double> skyIrradiance(const TracedRoom& room) {
    std::vector<double> sum(room.caches.lightmapCount);
    forEachSeenHit(room.hits, room.points, room.caches, 0, std::uint32_t(room.caches.size()),
                   [&](std::uint32_t c, std::uint32_t, std::uint32_t sender, double weight) {
                       if (c < sum.size() && isSky(room, sender))
                           sum[c] += weight;
                   });
    for (std::uint32_t c = 0; c < sum.size(); ++c)
        forEachSkyHit(room.hits, room.points, room.caches, c,
                      [&](std::uint32_t sender, const FormFactor& formFactor) {
                          EXPECT_GE(sender, room.set.surfels.size());
                          sum[c] += double(formFactor.irradiance);
                      });
    return sum;
}

/// Mean of the closed form over the cache's points.
double trueIrradiance(const TracedRoom& room, std::uint32_t c, float width) {
    double sum = 0;
    for (std::uint32_t k = room.points.begin[c]; k < room.points.begin[c + 1]; ++k)
        sum += double(
            rectangleIrradiance(window(width), room.points.position[k], room.points.normal[k]));
    return sum / double(kPi) / (room.points.begin[c + 1] - room.points.begin[c]);
}

struct SkyError {
    double bias, rms; ///< relative to the mean
};

SkyError errorOf(const TracedRoom& room, float width) {
    const std::vector<double> is = skyIrradiance(room);
    double sum = 0, truth = 0, squares = 0;
    for (std::uint32_t c = 0; c < is.size(); ++c) {
        const double t = trueIrradiance(room, c, width);
        sum += is[c];
        truth += t;
        squares += (is[c] - t) * (is[c] - t);
    }
    return {sum / truth - 1, std::sqrt(squares * double(is.size())) / truth};
}

class Window : public testing::TestWithParam<float> {};

TEST_P(Window, LightsTheRoomWithLessNoiseAndNoBias) {
    TracedRoom room(roomWithWindow(GetParam()), 8000);
    const SkyError chance = errorOf(room, GetParam());
    takeSkyHits(skyHitsOf(room), room.set.surfels.size(), room.hits);
    const SkyError aimed = errorOf(room, GetParam());
    std::printf("by chance %.3f %+.3f, aimed %.3f %+.3f\n", chance.rms, chance.bias, aimed.rms,
                aimed.bias);
    EXPECT_LT(aimed.rms, 0.7 * chance.rms);
    // Of nine densities, a window 1 m wide leaves +0.3 % on average, however rays are spread.
    const double noise = aimed.rms / std::sqrt(double(room.caches.lightmapCount));
    EXPECT_NEAR(aimed.bias, 0, 0.003 + 3 * noise);
}
INSTANTIATE_TEST_SUITE_P(Widths, Window, testing::Values(0.1f, 0.3f, 1.f));

TEST(SkyHits, CostNothingWhereNoSkyOrOnlySkyIsSeen) {
    SceneBuilder ground;
    ground.addMaterial(lambert(glm::vec3(0.5f)));
    ground.add(quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0}));
    for (Scene scene : {roomWithWindow(0), ground.build()}) {
        TracedRoom room(std::move(scene));
        const std::vector<std::uint32_t> before = room.hits.sender;
        const SkyHits samples = skyHitsOf(room);
        EXPECT_EQ(samples.rays, 0U);
        EXPECT_TRUE(samples.all.empty());
        takeSkyHits(samples, room.set.surfels.size(), room.hits);
        EXPECT_EQ(room.hits.sender, before);
    }
}

TEST(SkyHits, ReplaceTheHitsOfTheirCaches) {
    TracedRoom room(roomWithWindow(0.3f));
    takeSkyHits(skyHitsOf(room), room.set.surfels.size(), room.hits);
    std::uint32_t aimed = 0;
    for (std::uint32_t c = 0; c < room.caches.size(); ++c) {
        const bool has = room.hits.sky.begin[c] < room.hits.sky.begin[c + 1];
        aimed += has ? 1 : 0;
        for (std::uint32_t r = 0; r < room.hits.rays; ++r)
            EXPECT_FALSE(has && isSky(room, room.hits.sender[c * room.hits.rays + r]));
        for (std::uint32_t k = room.hits.sky.begin[c]; k < room.hits.sky.begin[c + 1]; ++k) {
            EXPECT_GE(room.hits.sky.all[k].point, room.points.begin[c]);
            EXPECT_LT(room.hits.sky.all[k].point, room.points.begin[c + 1]);
        }
    }
    EXPECT_GT(aimed, room.caches.lightmapCount / 2);
}

} // namespace
} // namespace limn::sky_hits_test
