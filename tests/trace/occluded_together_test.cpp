// SPDX-License-Identifier: MIT
#include "engine/trace/rays_together.h"

#include "tests/trace/masked.h"
#include "tests/trace/occluded_together.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::occluded_together_test {

using namespace simple;

namespace {

/// A room with a static ball, a dynamic box and a pane whose left half is cut out.
Scene furnishedRoom() {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.addMaterial(masked(b, {"mask", 2, 1, {0, 0, 0, 0, 9, 9, 9, 255}}, glm::vec3(1)));
    b.add(box(glm::vec3(-4), glm::vec3(4), true));
    b.add(sphere(1, 3, false), glm::translate(glm::mat4(1), {1, 1, 0}));
    b.add(box({-2, -2, -1}, {-1, 0, 1}, false), glm::mat4(1), true);
    b.add(quad({-3, -3, 2}, {6, 0, 0}, {0, 6, 0}, 1));
    return b.build();
}

/// Rays from all over the room, as long as given.
std::vector<Ray> raysIn(std::size_t count, float length) {
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> within(-1, 1);
    std::vector<Ray> rays;
    while (rays.size() < count) {
        const glm::vec3 from(within(engine), within(engine), within(engine)),
            way(within(engine), within(engine), within(engine));
        rays.push_back({3.9f * from, glm::normalize(way), 0, length});
    }
    return rays;
}

TEST(OccludedTogether, RaysHaveTheirOwnAnswerInAnyCompany) {
    const TraceScene trace(furnishedRoom());
    const std::vector<Ray> rays = raysIn(4000, 3);
    for (const TraceMask mask : {TraceMask::Static, TraceMask::Dynamic, TraceMask::All}) {
        std::size_t occluded = 0, begin = 0;
        for (std::size_t count = 0; begin + count <= rays.size();
             begin += count, count = (count + 1) % (RayPacket::kSize + 1)) {
            const std::uint32_t found = occludedTogether(trace, {&rays[begin], count}, mask);
            EXPECT_EQ(found >> count, 0u);
            for (std::size_t k = 0; k < count; ++k) {
                const bool alone = trace.occluded(rays[begin + k], mask);
                EXPECT_EQ((found >> k & 1) != 0, alone) << "ray " << begin + k;
                occluded += alone ? 1 : 0;
            }
        }
        EXPECT_GT(occluded, 50u);
        EXPECT_LT(occluded, begin - 50);
    }
}

TEST(OccludedTogether, ARayOfNoUseIsCountedAndHarmsNoOther) {
    const TraceScene trace(furnishedRoom());
    std::vector<Ray> rays(8, Ray{{0, 0, -3}, {0, 0, -1}});
    rays[1].origin.x = std::nanf("");
    rays[2].direction.y = std::numeric_limits<float>::infinity();
    rays[5].tFar = 0.5f;
    rays[6].tFar = -1; // an empty stretch
    EXPECT_EQ(occludedTogether(trace, rays), 0b10011001u);
    EXPECT_EQ(trace.badRays(), 2u);
}

TEST(OccludedTogether, AnEmptySceneHidesNothing) {
    const TraceScene trace(SceneBuilder().build());
    EXPECT_EQ(occludedTogether(trace, raysIn(8, 3)), 0u);
    EXPECT_EQ(occludedTogether(trace, {}), 0u);
}

TEST(OccludedTogether, RaysAreAllTracedInTheirOrder) {
    const TraceScene trace(furnishedRoom());
    const std::vector<Ray> all = raysIn(8 * RayPacket::kSize + 3, 3);
    std::vector<std::size_t> expected, found;
    const auto open = [&](std::size_t k) { found.push_back(k); };
    RaysTogether<std::size_t> rays(trace, TraceMask::Static);
    rays.flush(open);
    EXPECT_EQ(rays.traced(), 0u);
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (!trace.occluded(all[k], TraceMask::Static))
            expected.push_back(k);
        rays.add(all[k], k, open);
    }
    rays.flush(open);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(rays.traced(), all.size());
    EXPECT_LT(expected.size(), all.size());
    EXPECT_GT(expected.size(), 10u);
}

} // namespace
} // namespace limn::occluded_together_test
