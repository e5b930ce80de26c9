// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/seen_caches.h"

#include "engine/core/result.h"
#include "engine/lightmap/atlas.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "tests/techniques/illuminance/relight/differing_caches.h"
#include "tests/techniques/illuminance/shared_bake.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::seen_caches_test {
namespace {

using namespace simple;

/// A room with a box that turns, a ball whose chart folds, a mirrored and a double-sided sheet.
Scene room(LinkStorage storage = LinkStorage::Rtp, std::uint32_t bands = 3) {
    SceneBuilder b;
    b.addMaterial(lambert({0.7f, 0.5f, 0.3f}));
    Material sheet = lambert({0.3f, 0.6f, 0.6f});
    sheet.doubleSided = true;
    b.addMaterial(sheet);
    b.add(box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(box(glm::vec3(0), {0.8f, 1.2f, 0.6f}, false),
          glm::rotate(glm::translate(glm::mat4(1), {1, 0.1f, 1.5f}), 0.5f, {0, 1, 0}));
    b.add(sphere(0.4f, 2, false), glm::translate(glm::mat4(1), {3, 0.6f, 3.5f}));
    b.add(quad({0, 0, 0}, {0.7f, 0, 0}, {0, 0.9f, 0.2f}),
          glm::scale(glm::translate(glm::mat4(1), {1.2f, 1, 4}), {-1, 1, 1}));
    b.add(quad({2.2f, 0.3f, 2.5f}, {0.9f, 0, 0.4f}, {0, 1, 0}, 1));
    b.scene.lights.resize(1);
    b.scene.lights[0].position = {2, 2.5f, 2};
    b.scene.lights[0].strength = 5;
    Scene scene = b.build();
    scene.bake.surfels = 900; // fewer than caches: not all of those are read
    scene.bake.lightmapCaches = 1500;
    scene.bake.rays = 256;
    scene.bake.links = 64;
    scene.bake.bands = bands;
    scene.bake.grid = {2, 2, 2};
    scene.bake.storage = storage;
    return scene;
}

std::vector<Camera> cameras() {
    std::vector<Camera> all(5);
    all[0].eye = {0.2f, 1.5f, 0.3f}, all[0].target = {3, 1, 4};
    all[1].eye = {3.5f, 2.5f, 4.5f}, all[1].target = {1, 0, 1}, all[1].fovY = 0.4f;
    all[2].eye = {2, 0.3f, 3}, all[2].target = {2, 5, 3.1f}, all[2].fovY = 1.7f;
    all[3].eye = {6, 1.5f, 2.5f}, all[3].target = {2, 1.5f, 2.5f}; // from outside, through a wall
    all[4].eye = {2, 1.5f, 0.05f}, all[4].target = {2.1f, 1.4f, 0}, all[4].up = {0.6f, 0.8f, 0};
    return all;
}

struct Baked {
    explicit Baked(Scene made) : scene(std::move(made)), trace(scene) {
        bake = sharedBake(trace);
        footprints = cacheFootprints(scene, *bake);
    }
    CacheFlags seen(const Camera& camera, float aspect = 1.5f) const {
        return seenCaches(footprints, camera, aspect);
    }

    Scene scene;
    TraceScene trace;
    std::shared_ptr<const Bake> bake;
    CacheFootprints footprints;
};

/// The caches that rays through a picture's points look up.
CacheFlags lookedUp(const Baked& in, const Camera& camera, float aspect, int rays) {
    const LightmapLayout& layout = in.bake->lightmap;
    std::vector<std::uint32_t> cacheOf(std::size_t(layout.width) * layout.height, ~0U);
    for (std::uint32_t c = 0; c < in.bake->caches.lightmapCount; ++c)
        cacheOf[in.bake->caches.texel[c]] = c;
    CacheFlags flags(in.bake->caches.lightmapCount, 0);
    for (int k = 0; k < rays * rays; ++k) {
        const float x = float(k % rays) / float(rays - 1), y = float(k / rays) / float(rays - 1);
        const glm::vec3 d = rayDirection(camera, aspect, 2 * x - 1, 2 * y - 1);
        const Hit hit = in.trace.closestHit({camera.eye, glm::normalize(d)});
        if (!hit)
            continue;
        const Instance& instance = in.scene.instances[hit.instance];
        if (!hit.frontFace && !in.scene.materialOf(instance).doubleSided)
            continue; // drawn black
        const Bilinear at =
            bilinearAt(layout, lightmapUv(layout, hit.instance, instance.mesh, hit.triangle, hit.u,
                                          hit.v, !hit.frontFace));
        for (int i = 0; i < 4; ++i)
            if (at.weight[i] > 0 && cacheOf[at.texel[i]] != ~0U)
                flags[cacheOf[at.texel[i]]] = 1;
    }
    return flags;
}

std::size_t countOf(const CacheFlags& flags) {
    return std::size_t(std::ranges::count(flags, 1));
}

TEST(SeenCaches, HaveAllThatAPictureLooksUpAndNotMuchMore) {
    const Baked in(room());
    for (const Camera& camera : cameras()) {
        const CacheFlags seen = in.seen(camera), met = lookedUp(in, camera, 1.5f, 400);
        const bool outside = camera.eye.x > 4; // there all is black backs
        EXPECT_EQ(countOf(met) == 0, outside);
        for (std::size_t c = 0; c < seen.size(); ++c)
            EXPECT_GE(seen[c], met[c]) << "cache " << c << " of camera at " << camera.eye.x;
        EXPECT_LT(countOf(seen), seen.size() * 3 / 4);
    }
}

// The blocks of finer texels lie directly below the charts of the atlas, which must not claim them.
TEST(SeenCaches, HaveTheFinerTexelsThatAPictureLooksUp) {
    for (std::uint32_t texels = 1200; texels <= 2800; texels += 800) {
        Scene scene = room();
        scene.materials.push_back(lambert(glm::vec3(0), glm::vec3(1)));
        const auto lamp = std::uint32_t(scene.materials.size() - 1);
        scene.instances[1].material = lamp;
        scene.instances[2].material = lamp;
        scene.bake.lightmapCaches = texels;
        scene.bake.rays = 128;
        const Baked in(std::move(scene));
        ASSERT_TRUE(std::ranges::any_of(in.bake->lightmap.snaps,
                                        [](std::uint32_t s) { return (s & kFineLookup) != 0; }));
        for (const Camera& camera : cameras()) {
            const CacheFlags seen = in.seen(camera), met = lookedUp(in, camera, 1.5f, 200);
            std::size_t lost = 0;
            for (std::size_t c = 0; c < seen.size(); ++c)
                lost += met[c] && !seen[c] ? 1 : 0;
            EXPECT_EQ(lost, 0U) << texels << " texels";
        }
    }
}

TEST(SeenCaches, AreOutsideTheFieldOfViewByATexelAtMostAndNeverTurnTheirBack) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    Scene scene = b.build();
    scene.bake.surfels = 100;
    scene.bake.rays = 32;
    scene.bake.texelsPerMetre = 8;
    const Baked in(std::move(scene));
    const Caches& caches = in.bake->caches;
    for (const Camera& camera : cameras()) {
        const CacheFlags seen = in.seen(camera);
        const glm::mat4 view = viewMatrix(camera);
        const float t = std::tan(camera.fovY / 2) * 1.02f;
        std::size_t far = 0, backs = 0;
        for (std::size_t c = 0; c < seen.size(); ++c) {
            const glm::vec3 p = view * glm::vec4(caches.position[c], 1);
            const auto outside = [&](float x, float tangent) {
                return (std::abs(x) + tangent * p.z) / std::sqrt(1 + tangent * tangent);
            };
            const float beyond = std::max({outside(p.x, 1.5f * t), outside(p.y, t), p.z});
            // A texel reaches a texel beyond its cache: 1/8 m along either side of a wall.
            far += seen[c] != 0 && beyond > std::sqrt(2.f) / 8;
            backs +=
                seen[c] != 0 && glm::dot(caches.normal[c], camera.eye - caches.position[c]) < 0;
        }
        // But for last texels of charts that lie beside each other in the atlas: lookups at their
        // borders come within rounding of both. The walls have 6000 texels, 700 of them last ones.
        EXPECT_LT(far, 150U);
        EXPECT_LT(backs, 150U);
        EXPECT_GT(countOf(seen), 300U);
    }
}

TEST(SeenCaches, CachesWithoutFootprintAreAlwaysSeen) {
    CacheFootprints none;
    none.begin.assign(4, 0);
    EXPECT_EQ(seenCaches(none, Camera(), 1), CacheFlags(3, 1));
}

TEST(CacheRuns, AreTheFlagsInOrderAndNoneIsLong) {
    CacheFlags flags(300, 0);
    for (std::size_t c = 0; c < 300; ++c)
        flags[c] = (c >= 10 && c < 200) || c % 7 == 0;
    CacheFlags back(300, 0);
    std::uint32_t last = 0;
    CacheRuns runs;
    setRuns(flags, runs);
    for (const CacheRun run : runs) {
        EXPECT_LE(last, run.begin);
        EXPECT_LT(run.begin, run.end);
        EXPECT_LE(run.end - run.begin, kLongestRun);
        last = run.end;
        for (std::uint32_t c = run.begin; c < run.end; ++c)
            back[c] = 1;
    }
    EXPECT_EQ(back, flags);
    EXPECT_EQ(runsOf(0, 130), (CacheRuns{{0, 64}, {64, 128}, {128, 130}}));
}

const CacheFlags& everywhere(const Baked& in) {
    static CacheFlags all;
    all.assign(in.bake->caches.lightmapCount, 1);
    return all;
}

TEST(ViewDependentRelighting, IsTheSameBitByBitWhereItIsSeen) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (const std::uint32_t bands : {3U, 5U})
            for (const std::uint32_t chroma : {0U, 1U}) {
                Scene scene = room(storage, bands);
                scene.bake.chromaBands = chroma;
                const Baked in(std::move(scene));
                for (const std::uint32_t bounces : {1U, 2U, 64U})
                    for (const Camera& camera : cameras()) {
                        const CacheFlags seen = in.seen(camera);
                        Relighter all(in.bake, LitBands::All), few(in.bake, LitBands::All);
                        const RelightStats a = all.relight(in.scene, in.trace, bounces);
                        const RelightStats f = few.relight(in.scene, in.trace, bounces, {}, &seen);
                        EXPECT_EQ(a.cachesUnseen, 0U);
                        EXPECT_GT(f.cachesUnseen, seen.size() / 5);
                        EXPECT_GT(f.cachesUnread, 0U);
                        EXPECT_EQ(differing(*in.bake, all.field(), few.field(), seen), 0U);
                        EXPECT_GT(differing(*in.bake, all.field(), few.field(), everywhere(in)),
                                  100U);
                        EXPECT_EQ(all.field().grid, few.field().grid);
                    }
            }
}

TEST(ViewDependentRelighting, LightsWhatInvalidCachesAreFilledFrom) {
    Scene scene = room();
    scene.instances[1].toWorld[3].y = -0.5f; // sunk into the floor
    const Baked in(std::move(scene));
    const Caches& caches = in.bake->caches;
    Relighter all(in.bake);
    all.relight(in.scene, in.trace, 2);
    std::uint32_t invalid = 0;
    for (std::uint32_t c = 0; c < caches.lightmapCount && invalid < 5; ++c) {
        if (caches.fillBegin[c] == caches.fillBegin[c + 1])
            continue;
        ++invalid;
        CacheFlags one(caches.lightmapCount, 0);
        one[c] = 1;
        Relighter few(in.bake);
        few.relight(in.scene, in.trace, 2, {}, &one);
        EXPECT_EQ(differing(*in.bake, all.field(), few.field(), one), 0U);
        EXPECT_GT(differing(*in.bake, all.field(), few.field(), everywhere(in)), 100U);
    }
    EXPECT_GT(invalid, 1U);
}

TEST(ViewDependentRelighting, GoesOnBitByBitWhileTheLightStandsStill) {
    Scene scene = room(LinkStorage::Rtp, 5);
    scene.bake.chromaBands = 2;
    const Baked in(std::move(scene));
    const CacheFlags a = in.seen(cameras()[0]), b = in.seen(cameras()[1]);
    Relighter all(in.bake, LitBands::All), few(in.bake, LitBands::All);
    for (int call = 0; call < 4; ++call) {
        const CacheFlags& seen = call % 2 == 0 ? a : b;
        all.relight(in.scene, in.trace, 2);
        few.relight(in.scene, in.trace, 2, {}, &seen);
        ASSERT_EQ(differing(*in.bake, all.field(), few.field(), seen), 0U) << "call " << call;
        ASSERT_TRUE(all.radiosity() == few.radiosity());
    }
}

TEST(ViewDependentRelighting, ATurnedCameraAndARestShowTheNewestLight) {
    for (const std::uint32_t chroma : {0U, 2U}) {
        Scene scene = room(LinkStorage::Rtp, 5);
        scene.bake.chromaBands = chroma;
        Baked in(std::move(scene));
        const CacheFlags a = in.seen(cameras()[0]), b = in.seen(cameras()[1]);
        Relighter all(in.bake, LitBands::All), few(in.bake, LitBands::All);
        all.relight(in.scene, in.trace, 64);
        ASSERT_TRUE(few.relight(in.scene, in.trace, 64, {}, &a).converged);
        ASSERT_GT(differing(*in.bake, all.field(), few.field(), b), 0U);
        const std::vector<glm::vec4> before = few.radiosity();
        // The camera turns, the light stands.
        const RelightStats turned = few.relight(in.scene, in.trace, 2, {}, &b);
        EXPECT_FALSE(turned.skipped);
        EXPECT_EQ(turned.bounces, 0U);
        EXPECT_EQ(turned.shadowRays, 0U);
        EXPECT_GT(turned.cachesUnseen, 0U);
        EXPECT_EQ(differing(*in.bake, all.field(), few.field(), b), 0U);
        EXPECT_EQ(differing(*in.bake, all.field(), few.field(), a), 0U);
        // Back again: all of that is lit.
        EXPECT_TRUE(few.relight(in.scene, in.trace, 2, {}, &a).skipped);
        // At rest the rest is lit, and then nothing is left.
        EXPECT_EQ(few.relight(in.scene, in.trace, 2).cachesUnseen, 0U);
        EXPECT_EQ(few.field().lightmap, all.field().lightmap);
        EXPECT_TRUE(few.radiosity() == before);
        EXPECT_TRUE(few.relight(in.scene, in.trace, 2, {}, &b).skipped);
    }
}

TEST(ViewDependentRelighting, WithoutBouncesLightsWhatIsMissingOfUnfinishedLightToo) {
    const Baked in(room());
    const CacheFlags a = in.seen(cameras()[0]);
    Relighter all(in.bake, LitBands::All), few(in.bake, LitBands::All);
    all.relight(in.scene, in.trace, 2);
    few.relight(in.scene, in.trace, 2, {}, &a);
    EXPECT_EQ(few.relight(in.scene, in.trace, 0).bounces, 0U);
    EXPECT_EQ(few.field().lightmap, all.field().lightmap);
    all.relight(in.scene, in.trace, 2); // and surfels read on as if nothing had been put off
    few.relight(in.scene, in.trace, 2, {}, &a);
    EXPECT_EQ(differing(*in.bake, all.field(), few.field(), a), 0U);
}

/// Light at seen caches while a lamp moves, relative to all being lit in every call.
double movingError(const Baked& in, std::uint32_t bounces, float step) {
    const CacheFlags seen = in.seen(cameras()[0]);
    Relighter all(in.bake, LitBands::All), few(in.bake, LitBands::All);
    Scene scene = in.scene;
    all.relight(scene, in.trace, 64);
    few.relight(scene, in.trace, 64);
    double square = 0, difference = 0;
    for (int frame = 0; frame < 12; ++frame) {
        scene.lights[0].position += glm::vec3(step, -step / 2, step);
        all.relight(scene, in.trace, bounces);
        few.relight(scene, in.trace, bounces, {}, &seen);
        for (std::size_t c = 0; c < seen.size(); ++c) {
            const std::size_t at = in.bake->caches.texel[c];
            if (seen[c] == 0)
                continue;
            const glm::vec4 x = all.field().lightmap[at], d = few.field().lightmap[at] - x;
            square += double(glm::dot(x, x));
            difference += double(glm::dot(d, d));
        }
    }
    return std::sqrt(difference / square);
}

TEST(ViewDependentRelighting, InMovingLightOnlyTheFourthBounceIsLate) {
    const Baked in(room());
    EXPECT_EQ(movingError(in, 1, 0.1f), 0.0); // nothing is put off
    const double error = movingError(in, 2, 0.1f);
    std::printf("nRMSE of a lamp that moves 15 cm a call: %.5f\n", error);
    EXPECT_GT(error, 0.0);
    // What changes with a step, one call late, after three more reflections: at most 0.6^3 of it.
    EXPECT_LT(error, 0.02);
    // At rest it is gone.
    const CacheFlags seen = in.seen(cameras()[0]);
    Relighter all(in.bake), few(in.bake);
    Scene scene = in.scene;
    for (int frame = 0; frame < 4; ++frame) {
        scene.lights[0].position.x += 0.2f;
        few.relight(scene, in.trace, 2, {}, &seen);
    }
    all.relight(scene, in.trace, 64);
    few.relight(scene, in.trace, 64, {}, &seen);
    const std::size_t texel =
        in.bake->caches.texel[std::size_t(std::ranges::find(seen, 1) - seen.begin())];
    const glm::vec4 x = all.field().lightmap[texel], y = few.field().lightmap[texel];
    EXPECT_LT(glm::length(x - y), 1e-3f * glm::length(x));
}

TEST(ViewDependentRelighting, OccludesWhatIsSeen) {
    SceneBuilder b;
    Scene made = room();
    b.scene = made;
    b.assets = std::make_shared<Assets>(*made.assets);
    b.add(box(glm::vec3(-0.3f), glm::vec3(0.3f), false), glm::translate(glm::mat4(1), {2, 1.2f, 2}),
          true);
    made = b.build();
    const Baked in(std::move(made));
    const CacheFlags seen = in.seen(cameras()[0]);
    Relighter all(in.bake), few(in.bake);
    EXPECT_GT(all.relight(in.scene, in.trace, 2).cachesOccluded, 100U);
    few.relight(in.scene, in.trace, 2, {}, &seen);
    EXPECT_EQ(differing(*in.bake, all.field(), few.field(), seen), 0U);
    EXPECT_EQ(all.field().grid, few.field().grid);
    few.relight(in.scene, in.trace, 0);
    EXPECT_EQ(few.field().lightmap, all.field().lightmap);
}

} // namespace
} // namespace limn::seen_caches_test
