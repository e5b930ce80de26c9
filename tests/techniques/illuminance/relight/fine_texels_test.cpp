// SPDX-License-Identifier: MIT
#include "engine/field/sample_field.h"
#include "engine/lightmap/fine_texels.h"

#include "engine/lightmap/atlas.h"
#include "engine/math/sampling.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "tests/core/sweep.h"
#include "tests/techniques/illuminance/bake/house_on_ground.h"
#include "tests/techniques/illuminance/relight/relit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace limn::fine_texels_test {
namespace {

constexpr std::uint32_t kGround = 0;

Scene house(float scale, std::uint32_t texels, bool closed = true) {
    Scene scene = houseOnGround(scale, closed).build();
    scene.bake.lightmapCaches = texels;
    scene.bake.surfels = 4000;
    return scene;
}

/// Below a place above the ground.
Hit groundAt(const TraceScene& trace, float x, float z, float scale) {
    return trace.closestHit({glm::vec3(x, 1, z) * scale, {0, -1, 0}});
}

/// Bounced irradiance of the ground over that below the open sky.
double groundLight(const Relit& lit, float x, float z, float scale) {
    const Hit hit = groundAt(lit.trace, x, z, scale);
    EXPECT_EQ(hit.instance, kGround);
    return double(sampleIrradiance({lit.relighter.field(), lit.baked->lightmap, lit.trace.scene(),
                                    hit.instance, hit.triangle, hit.u, hit.v, hit.position,
                                    hit.geometricNormal, false})
                      .x) /
           std::numbers::pi;
}

// With texels of one width all over the ground, .90 of the sky's light was on the floor at 1 000
// texels, and .84 at 2 000.
TEST(FineTexels, KeepTheSkyOutOfAClosedHouse) {
    for (const auto& [scale, texels] : {std::pair(1.f, 1000U), {0.01f, 2000U}, {300.f, 12000U}}) {
        if (kSanitized && texels != 1000)
            continue;
        const Relit lit(house(scale, texels));
        double inside = 0, outside = 0;
        constexpr int kPlaces = 400;
        for (int i = 0; i < kPlaces; ++i) {
            const auto k = std::uint32_t(i + 1);
            inside += groundLight(lit, 0.1f + 5.8f * radicalInverse(k, 2),
                                  0.1f + 4.8f * radicalInverse(k, 3), scale);
            outside += groundLight(lit, 30 + 50 * radicalInverse(k, 2),
                                   -60 + 100 * radicalInverse(k, 3), scale);
        }
        EXPECT_LT(inside / kPlaces, 0.01) << scale << ", " << texels << " texels";
        EXPECT_NEAR(outside / kPlaces, 1, 0.02) << scale << ", " << texels << " texels";
    }
}

// Bilinear lookups of the texels' own places give the place that was looked up.
TEST(FineTexels, LieWhereTheirLookupsAre) {
    const Relit lit(house(1, 12000));
    const LightmapLayout& layout = lit.baked->lightmap;
    std::vector<std::uint32_t> cacheAt(std::size_t(layout.width) * layout.height, ~0U);
    for (std::uint32_t c = 0; c < lit.caches.lightmapCount; ++c)
        cacheAt[lit.caches.texel[c]] = c;
    int fine = 0;
    for (std::uint32_t i = 1; i <= 2000; ++i) {
        const float x = 0.4f + 5.2f * radicalInverse(i, 2), z = 0.4f + 4.2f * radicalInverse(i, 3);
        const Hit hit = groundAt(lit.trace, x, z, 1);
        const glm::vec2 uv = unsnappedUv(layout, kGround, 0, hit.triangle, hit.u, hit.v, false);
        const AtlasLookup at = lookupAt(layout, uv);
        ASSERT_TRUE(at.inside);
        fine += at.base != glm::floor(uv * glm::vec2(layout.width, layout.height) - 0.5f);
        const Bilinear read = bilinearAt(layout, snappedUv(layout, at.base, at.f, 0));
        glm::vec3 mean(0);
        for (int k = 0; k < 4; ++k) {
            if (read.weight[k] < 1e-4f)
                continue;
            ASSERT_NE(cacheAt[read.texel[k]], ~0U) << x << ' ' << z;
            mean += read.weight[k] * lit.caches.position[cacheAt[read.texel[k]]];
        }
        EXPECT_LT(glm::length(mean - hit.position), 0.06f) << x << ' ' << z;
    }
    EXPECT_GT(fine, 1900);
}

TEST(FineTexels, DoNotExceedTheTexelsAskedFor) {
    for (const std::uint32_t texels : {500U, 3000U, 12000U}) {
        if (kSanitized && texels > 500)
            continue;
        const Relit lit(house(1, texels));
        // A twentieth more are surfels' own.
        EXPECT_LT(lit.caches.lightmapCount, 1.05 * texels + 10) << texels;
        EXPECT_GT(lit.caches.lightmapCount, 0.5 * texels) << texels;
    }
}

TEST(FineTexels, AreNotThereWhereTheGroundIsNoWiderThanTheHouse) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(0), glm::vec3(6, 3, 5), true));
    b.add(simple::box(glm::vec3(2, 0.1f, 2), glm::vec3(3, 1, 3), false));
    Scene scene = b.build();
    scene.bake.lightmapCaches = 3000;
    scene.bake.surfels = 500;
    scene.bake.rays = 32;
    const Bake bake = *limn::bake(TraceScene(scene));
    EXPECT_TRUE(std::ranges::none_of(
        bake.lightmap.snaps, [](std::uint32_t s) { return s != ~0U && (s & kFineLookup) != 0; }));
}

// A damaged file may lead a lookup to itself.
TEST(FineTexels, LookupsEndThoughBlocksLeadToEachOther) {
    LightmapLayout layout;
    layout.width = layout.height = 8;
    layout.snaps.assign(64, kFineLookup | 0U);
    const glm::vec2 uv = snapLookup(layout, glm::vec2(0.3f, 0.6f));
    EXPECT_GE(uv.x, 0);
    EXPECT_LE(uv.x, 1);
    EXPECT_GE(uv.y, 0);
    EXPECT_LE(uv.y, 1);
}

} // namespace
} // namespace limn::fine_texels_test
