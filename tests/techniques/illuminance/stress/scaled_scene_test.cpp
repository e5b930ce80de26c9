// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/stress/scene_change.h"

#include "engine/gallery/hostile_scene.h"
#include "engine/techniques/illuminance/stress/lit_scene.h"

#include <gtest/gtest.h>

namespace limn::scaled_scene_test {
namespace {

// Hostile scenes of a micrometre, a tenth of a millimetre and a millimetre with needles in it: only
// a constant in metres, or what underflows, can tell them from larger ones.
TEST(ScaledScene, IsLitAlikeByTheSameBits) {
    for (const std::uint64_t seed : {9033U, 20779U, 21335U}) {
        const HostileScene made = hostileScene(seed);
        const Scene scene = flatten(made.document, made.assets);
        const Result<LitScene> base = bakeAndLight(scene, {});
        ASSERT_TRUE(base) << seed;
        for (const float scale : {2.f, 16.f, 1024.f}) {
            const Result<LitScene> scaled = bakeAndLight(scaledScene(scene, scale), {});
            ASSERT_TRUE(scaled) << seed;
            ASSERT_EQ(scaled->bake->surfels.size(), base->bake->surfels.size());
            for (std::size_t i = 0; i < base->bake->surfels.lightPoints.size(); ++i)
                ASSERT_EQ(scaled->bake->surfels.lightPoints[i],
                          base->bake->surfels.lightPoints[i] * scale)
                    << seed << ' ' << scale;
            EXPECT_EQ(scaled->bake->caches.links, base->bake->caches.links) << seed << ' ' << scale;
        }
    }
}

} // namespace
} // namespace limn::scaled_scene_test
