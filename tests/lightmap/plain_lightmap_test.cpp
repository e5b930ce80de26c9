// SPDX-License-Identifier: MIT
// A plain lightmap, looked up as any program looks up a texture, equals the layout's own lookup.
#include "engine/lightmap/plain_lightmap.h"

#include "engine/field/sample_field.h"
#include "engine/lightmap/atlas.h"
#include "engine/lightmap/charts.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "tests/lightmap/furniture.h"
#include "tests/techniques/illuminance/bake/parted_hall.h"
#include "tests/techniques/illuminance/relight/relit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <glm/geometric.hpp>

namespace limn::plain_lightmap_test {
namespace {

using namespace simple;

LightmapLayout layoutOf(const Scene& scene) {
    std::vector<MeshCharts> charts;
    for (const Mesh& mesh : scene.assets->meshes)
        charts.push_back(buildCharts(mesh));
    return buildAtlas(scene, std::move(charts), scene.bake).layout;
}

float plainValue(const PlainLightmap& plain, const std::vector<float>& values, glm::vec2 uv) {
    LightmapLayout texture;
    texture.width = plain.width;
    texture.height = plain.height;
    const Bilinear lookup = bilinearAt(texture, uv);
    float sum = 0;
    for (int k = 0; k < 4; ++k) {
        const PlainTexel& texel = plain.texels[plain.texelAt[lookup.texel[k]]];
        for (int j = 0; j < 4; ++j)
            sum += lookup.weight[k] * texel.weight[j] * values[texel.texel[j]];
    }
    return sum;
}

/// Calls visit(instance, triangle, u, v, back) for random points of all sides.
template <class Visit>
void forRandomPoints(const Scene& scene, const LightmapLayout& layout, int count,
                     const Visit& visit) {
    std::mt19937 rng(5);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < count; ++i) {
        const auto instance = std::uint32_t(rng() % scene.instances.size());
        const Mesh& mesh = scene.meshOf(scene.instances[instance]);
        const auto triangle = std::uint32_t(rng() % mesh.triangleCount());
        const float root = std::sqrt(unit(rng)), v = unit(rng) * root;
        const bool back = layout.instances[instance].backRows > 0 && rng() % 2 == 0;
        visit(instance, triangle, 1 - root, v, back);
    }
}

TEST(PlainLightmap, ReadsWhatTheLayoutReadsWhereThatHasNoSnaps) {
    const Scene scene = furniture();
    const LightmapLayout layout = layoutOf(scene);
    ASSERT_TRUE(layout.snaps.empty());
    const PlainLightmap plain = plainLightmap(scene, layout, 1);
    ASSERT_EQ(plain.width, layout.width);
    ASSERT_EQ(plain.height, layout.height);
    std::mt19937 rng(7);
    std::vector<float> values(std::size_t(layout.width) * layout.height);
    for (float& value : values)
        value = float(rng() % 1000);
    forRandomPoints(
        scene, layout, 5000, [&](std::uint32_t i, std::uint32_t t, float u, float v, bool back) {
            const glm::vec2 uv = unsnappedUv(layout, i, scene.instances[i].mesh, t, u, v, back);
            const Bilinear own = bilinearAt(layout, uv);
            float expected = 0;
            for (int k = 0; k < 4; ++k)
                expected += own.weight[k] * values[own.texel[k]];
            ASSERT_NEAR(plainValue(plain, values, uv), expected, 0.2f) << i << " " << t;
        });
}

TEST(PlainLightmap, EveryTexelHasAValue) {
    const Scene scene = furniture();
    const LightmapLayout layout = layoutOf(scene);
    for (const std::uint32_t factor : {1U, 3U}) {
        const PlainLightmap plain = plainLightmap(scene, layout, factor);
        ASSERT_EQ(plain.texelAt.size(), std::size_t(plain.width) * plain.height);
        for (const std::uint32_t at : plain.texelAt)
            ASSERT_LT(at, plain.texels.size());
        for (const PlainTexel& texel : plain.texels) {
            EXPECT_NEAR(glm::dot(texel.weight, glm::vec4(1)), 1, 1e-5f);
            EXPECT_TRUE(texel.u >= 0 && texel.v >= 0 && texel.u + texel.v <= 1.0001f);
        }
    }
}

TEST(PlainLightmap, IsEmptyWithoutLightmap) {
    Scene scene = furniture();
    for (Instance& instance : scene.instances)
        instance.dynamic = true;
    EXPECT_TRUE(plainLightmap(scene, layoutWithoutLightmap(scene), 3).texels.empty());
}

TEST(PlainLightmap, ReadsOnlyTexelsThatHaveACache) {
    const Scene scene = partedHall(0, 600);
    const TraceScene trace(scene);
    const std::shared_ptr<const Bake> bake = bakeOf(trace);
    std::vector<char> hasCache(std::size_t(bake->lightmap.width) * bake->lightmap.height, 0);
    for (std::uint32_t c = 0; c < bake->caches.lightmapCount; ++c)
        hasCache[bake->caches.texel[c]] = 1;
    for (const std::uint32_t factor : {1U, 3U, 5U})
        for (const PlainTexel& texel : plainLightmap(scene, bake->lightmap, factor).texels)
            for (int k = 0; k < 4; ++k)
                ASSERT_TRUE(texel.weight[k] == 0 || hasCache[texel.texel[k]]) << factor;
}

/// Mean irradiance that plain lookups bring through a closed wall into the dark part of a hall.
double leakOf(const Scene& scene, const Relit& lit, std::uint32_t factor) {
    const LightmapLayout& layout = lit.baked->lightmap;
    const IndirectField& field = lit.relighter.field();
    const PlainLightmap plain = plainLightmap(scene, layout, factor);
    std::vector<float> mean(std::size_t(layout.width) * layout.height);
    for (std::size_t t = 0; t < mean.size(); ++t)
        mean[t] = field.lightmap[t].x;
    double sum = 0;
    int points = 0;
    forRandomPoints(
        scene, layout, 40000, [&](std::uint32_t i, std::uint32_t t, float u, float v, bool back) {
            const glm::vec3 p = trianglePoint(scene.meshOf(scene.instances[i]), t, {u, v});
            if (p.x > 3.69f || i > 0)
                return; // beyond the wall, or of the wall itself
            sum += plainValue(plain, mean,
                              unsnappedUv(layout, i, scene.instances[i].mesh, t, u, v, back));
            ++points;
        });
    return sum / points;
}

TEST(PlainLightmap, FollowsWallsTheMoreCloselyTheFinerItIs) {
    const Scene scene = partedHall(0, 600);
    const Relit lit(scene);
    const double coarse = leakOf(scene, lit, 1), fine = leakOf(scene, lit, 3),
                 finest = leakOf(scene, lit, 9);
    EXPECT_GT(coarse, 0);
    EXPECT_LT(fine, coarse / 2);
    EXPECT_LT(finest, fine / 2);
}

} // namespace
} // namespace limn::plain_lightmap_test
