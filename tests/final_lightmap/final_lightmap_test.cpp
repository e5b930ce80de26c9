// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/final_lightmap.h"

#include "engine/core/parallel.h"
#include "engine/final_lightmap/fit_input.h"
#include "engine/lightmap/atlas.h"
#include "engine/lightmap/charts.h"
#include "engine/lightmap/plain_lightmap.h"
#include "engine/math/sh.h"
#include "engine/reference/path.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace limn::final_lightmap_test {
namespace {

using namespace simple;

/// A scene whose field has a few texels, all of which hold the same light, right or wrong.
struct Lit {
    Scene scene;
    TraceScene trace;
    LightmapLayout layout;
    IndirectField field, emitted;

    explicit Lit(Scene lit, glm::vec3 radiance = glm::vec3(0.1f))
        : scene(std::move(lit)), trace(scene) {
        std::vector<MeshCharts> charts;
        for (const Mesh& mesh : scene.assets->meshes)
            charts.push_back(buildCharts(mesh));
        BakeSettings settings;
        settings.lightmapCaches = 60;
        layout = buildAtlas(scene, charts, settings).layout;
        field.version = emitted.version = 1;
        for (IndirectField* f : {&field, &emitted}) {
            const std::size_t texels = std::size_t(layout.width) * layout.height;
            f->lightmapWidth = layout.width;
            f->lightmapHeight = layout.height;
            f->lightmap.assign(9 * texels, glm::vec4(0));
            for (std::size_t t = 0; t < texels; ++t)
                f->lightmap[t] = glm::vec4(std::sqrt(4 * glm::pi<float>()) * radiance, 0);
        }
    }
    FinalLightmap make(const FinalLightmapOptions& options) const {
        const auto map = makeFinalLightmap({trace, layout, field, emitted}, options, {});
        EXPECT_TRUE(map);
        return map.value_or(FinalLightmap{});
    }
    /// What a bilinear lookup shows in each layer.
    std::vector<glm::vec3> shown(const FinalLightmap& map, const Hit& hit) const {
        const MeshPoint p = map.cut.fromSource(hit.instance, {hit.triangle, {hit.u, hit.v}});
        const glm::vec2 uv =
            unsnappedUv(map.layout, hit.instance, map.cut.scene.instances[hit.instance].mesh,
                        p.triangle, p.barycentric.x, p.barycentric.y, !hit.frontFace);
        const Bilinear lookup = bilinearAt(map.layout, uv);
        std::vector<glm::vec3> layers(map.layers);
        for (std::uint32_t l = 0; l < map.layers; ++l)
            for (std::size_t k = 0; k < 4; ++k)
                if (lookup.weight[k] > 1e-4f)
                    layers[l] += lookup.weight[k] *
                                 map.values[l * map.texels() + map.texelAt[lookup.texel[k]]];
        return layers;
    }
    /// A hit on the surface below a point.
    Hit below(glm::vec3 from) const { return trace.closestHit({from, {0, -1, 0}}); }
    glm::vec3 truth(const Hit& hit, std::uint32_t paths = 4096) const {
        const Emitters emitters = findEmitters(trace);
        const SkyLight sky = findSkyLight(scene.sky);
        const PathContext context{trace, emitters, sky};
        glm::vec3 sum(0);
        std::uint64_t rays = 0;
        const SurfacePoint p = *surfacePoint(trace, hit);
        for (std::uint32_t s = 0; s < paths; ++s)
            sum += sampleIndirectIrradiance(context, p, {7, s}, rays) / float(paths);
        return sum;
    }
};

/// A floor of 4 m under an even sky, with a plate of 2 m one metre above its middle.
Scene belowAPlate() {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}));
    b.add(quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}));
    b.scene.sky.radiance = {1, 2, 3};
    return b.build();
}

TEST(FinalLightmap, ShowsLightThatTheFieldLacks) {
    const Lit lit(belowAPlate());
    const FinalLightmap map = lit.make({.texels = 1500});
    double error = 0, truth = 0;
    int count = 0;
    for (float x = -1.9f; x < 2; x += 0.31f) {
        const Hit hit = lit.below({x, 0.5f, 0.13f});
        const float wrong = lit.shown(map, hit)[0].x - lit.truth(hit).x;
        error += double(wrong * wrong);
        truth += double(lit.truth(hit).x);
        ++count;
    }
    EXPECT_LT(std::sqrt(error / count), 0.04 * truth / count);
}

TEST(FinalLightmap, HoldsDirectLightWhereItIsAskedTo) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0)));
    b.add(quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}));
    Light sun{.kind = LightKind::Directional, .strength = 3};
    sun.direction = {0, -1, 0};
    b.scene.lights = {sun};
    const Lit lit(b.build(), glm::vec3(0));
    const Hit hit = lit.below({0.4f, 1, 0.7f});
    for (const std::uint32_t bands : {1U, 2U, 3U}) {
        std::vector<glm::vec3> c =
            lit.shown(lit.make({.texels = 400, .direct = true, .bands = bands}), hit);
        EXPECT_NEAR(bands == 1 ? c[0].x : shIrradiance(int(bands), c.data(), {0, 1, 0}).x, 3, 0.01f)
            << bands;
    }
    EXPECT_NEAR(lit.shown(lit.make({.texels = 400}), hit)[0].x, 0, 1e-6f);
    EXPECT_NEAR(lit.shown(lit.make({.texels = 400,
                                    .quantity = LightmapQuantity::IrradianceOverPi,
                                    .direct = true}),
                          hit)[0]
                    .x,
                3 / glm::pi<float>(), 0.01f);
}

/// An even sky of radiance L above a plane has the coefficients L sqrt(pi), L sqrt(3 pi) / 2 about
/// the normal, and no others.
TEST(FinalLightmap, HoldsHarmonicsOfIncidentRadiance) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}));
    b.scene.sky.radiance = {1, 2, 3};
    const Lit lit(b.build());
    const FinalLightmap map = lit.make({.texels = 400, .bands = 3});
    std::vector<glm::vec3> c(9);
    constexpr int kPlaces = 16;
    for (int k = 0; k < kPlaces; ++k) {
        const std::vector<glm::vec3> here =
            lit.shown(map, lit.below({float(k % 4) - 1.4f, 1, float(k / 4) - 1.6f}));
        for (std::size_t i = 0; i < c.size(); ++i)
            c[i] += here[i] / float(kPlaces);
    }
    const float pi = glm::pi<float>();
    EXPECT_NEAR(c[0].y, 2 * std::sqrt(pi), 0.1f);
    EXPECT_NEAR(c[1].y, 2 * std::sqrt(3 * pi) / 2, 0.1f);
    for (std::size_t i = 2; i < 9; ++i)
        EXPECT_NEAR(c[i].y, 0, 0.15f) << i;
    EXPECT_NEAR(shIrradiance(3, c.data(), {0, 1, 0}).y, 2 * pi, 0.02f);
}

/// A wall of 15 cm that passes through the floor stands between a lamp and a dark half.
Scene walledFloor() {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.addMaterial(lambert(glm::vec3(0), glm::vec3(5)));
    b.add(quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}));
    b.add(box({-0.1f, -0.2f, -2.1f}, {0.05f, 2, 2.1f}, false));
    b.add(quad({-1.2f, 1.5f, -0.5f}, {1, 0, 0}, {0, 0, 1}, 1));
    return b.build();
}

TEST(FinalLightmap, HasNoStripAtTheFootOfAWall) {
    const Lit lit(walledFloor());
    const FinalLightmap map = lit.make({.texels = 4000});
    double worst = 0;
    for (const float x : {-0.19f, -0.15f, -0.11f, 0.06f, 0.1f, 0.14f})
        for (float z = -1.5f; z < 1.6f; z += 0.5f) {
            const Hit hit = lit.below({x, 0.5f, z});
            ASSERT_EQ(hit.instance, 0U);
            const double truth = double(lit.truth(hit, 2048).x);
            worst = std::max(worst, double(lit.shown(map, hit)[0].x) - truth);
        }
    const double mean = double(lit.truth(lit.below({-1, 0.5f, 0}), 2048).x);
    EXPECT_LT(worst, 0.1 * mean);
}

/// A closed box of two sides stands on the floor: its inner sides and the floor below it are dark.
TEST(FinalLightmap, LeavesSealedSpaceOut) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    Material sheet = lambert(glm::vec3(0.5f));
    sheet.doubleSided = true;
    b.addMaterial(sheet);
    b.add(quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}));
    b.add(box({-0.5f, -0.01f, -0.5f}, {0.5f, 1, 0.5f}, false, 1));
    b.scene.sky.radiance = {1, 1, 1};
    b.scene.cameras = {{.eye = {3, 1, 3}}};
    const Lit lit(b.build(), glm::vec3(0));
    const FinalLightmap map = lit.make({.texels = 3000});
    EXPECT_EQ(map.layout.instances[1].backRows, 0U);
    // Right beside the box, half of the sky is hidden: the floor is lit by it, and by the box.
    for (const float x : {0.52f, 0.56f, 0.62f}) {
        const Hit hit = lit.below({x, 0.5f, 0.1f});
        const float truth = lit.truth(hit).x;
        EXPECT_NEAR(lit.shown(map, hit)[0].x, truth, 0.05f * truth) << x;
    }
}

/// Texels of a triangle that is thinner than they are, and drawn across them.
LitTexels thinTexels(const Scene& scene) {
    return layLitTexels(cutScene(scene, {buildCharts(scene.meshOf(scene.instances[0]))}, {}), {},
                        {.texels = 60}, {});
}
Scene thinTriangle() {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(flatShaded({{0, 0, 0}, {4, 0, -1}, {4, 0, -1.02f}}, 0));
    b.scene.sky.radiance = {1, 1, 1};
    return b.build();
}

TEST(FinalLightmap, TexelsWithoutSurfaceInsideCountForLittle) {
    const Scene scene = thinTriangle();
    LitTexels lit = thinTexels(scene);
    lit.atlas.texels[3].count = 1;
    const std::vector<FittedPoint> points = fittedPoints(lit);
    const TexelFitInput input = fitInput(scene, lit, points);
    for (std::size_t p = 0; p < points.size(); ++p) {
        const std::uint32_t count = lit.atlas.texels[points[p].texel].count;
        EXPECT_FLOAT_EQ(input.weights[p], count == 1 ? 0.02f : 1 / float(count));
    }
}

TEST(FinalLightmap, DoesNotDependOnThreads) {
    const Lit lit(belowAPlate());
    const auto madeBy = [&](int threads) {
        const ThreadLimit limit(threads);
        return lit.make({.texels = 300, .bands = 2}).values;
    };
    EXPECT_EQ(madeBy(1), madeBy(2));
}

TEST(FinalLightmap, FitsIntoAPage) {
    const Lit lit(belowAPlate());
    const FinalLightmap map = lit.make({.texels = 20000, .maxSide = 64, .onePage = true});
    EXPECT_LE(std::max(map.layout.width, map.layout.height), 64U);
    EXPECT_GT(map.texels(), 1000U);
}

TEST(FinalLightmap, CanBeCancelled) {
    const Lit lit(belowAPlate());
    std::atomic<bool> cancel = true;
    Progress progress;
    progress.cancel = &cancel;
    EXPECT_FALSE(makeFinalLightmap({lit.trace, lit.layout, lit.field, lit.emitted}, {}, progress));
}

} // namespace
} // namespace limn::final_lightmap_test
