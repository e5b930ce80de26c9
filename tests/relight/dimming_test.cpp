// SPDX-License-Identifier: MIT
#include "engine/relight/dimming.h"

#include "engine/core/parallel.h"
#include "engine/math/sampling.h"
#include "engine/math/sh.h"
#include "engine/relight/relight.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

namespace limn {
namespace {

using namespace simple;

constexpr float kPi = std::numbers::pi_v<float>;

/// A closed room of 4 x 3 x 5 m, all of whose walls send `emission`, with a black dynamic object.
Scene room(const Mesh& object, const glm::mat4& at, LinkStorage storage = LinkStorage::Rtp) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0), glm::vec3(1)));
    b.addMaterial(lambert(glm::vec3(0)));
    b.add(box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    Mesh black = object;
    black.material = 1;
    b.add(black, at, true);
    Scene scene = b.build();
    scene.bake.surfels = 2000;
    scene.bake.lightmapCaches = 900;
    scene.bake.rays = 512;
    scene.bake.links = 128;
    scene.bake.grid = {6, 5, 8};
    scene.bake.storage = storage;
    return scene;
}

glm::mat4 moved(glm::vec3 by) {
    return glm::translate(glm::mat4(1), by);
}

std::shared_ptr<const Bake> baked(const Scene& scene) {
    Result<Bake> made = bake(TraceScene(scene));
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return std::make_shared<const Bake>(std::move(*made));
}

/// The share of the light from all round that a lightmap cache gets past the dynamic objects.
float openShare(const TraceScene& trace, glm::vec3 p, glm::vec3 n) {
    constexpr std::uint32_t kRays = 2048;
    const glm::mat3 toWorld = basisAround(n);
    std::uint32_t open = 0;
    for (std::uint32_t i = 0; i < kRays; ++i) {
        const float r = std::sqrt((float(i) + 0.5f) / kRays), a = 2 * kPi * radicalInverse(i, 2);
        const glm::vec3 d(r * std::cos(a), r * std::sin(a), std::sqrt(1 - r * r));
        open += trace.occluded({trace.clearOf(p, n), toWorld * d}, TraceMask::Dynamic) ? 0 : 1;
    }
    return float(open) / kRays;
}

struct Errors {
    double mean = 0, undimmed = 0, most = 0; ///< of the irradiance of caches, over pi
};

Errors errors(const Scene& scene) {
    const TraceScene trace(scene);
    const auto bake = baked(scene);
    Relighter relighter(bake);
    relighter.relight(scene, trace, 8);
    const Caches& c = bake->caches;
    Errors e;
    for (std::uint32_t i = 0; i < c.lightmapCount; ++i) {
        const float open = openShare(trace, c.position[i], c.normal[i]);
        const float is = shIrradiance(3, relighter.cacheSh().data() + 9 * i, c.normal[i]).x / kPi;
        EXPECT_TRUE(std::isfinite(is));
        e.mean += std::abs(double(is - open)) / c.lightmapCount;
        e.undimmed += double(1 - open) / c.lightmapCount;
        e.most = std::max(e.most, std::abs(double(is - open)));
    }
    return e;
}

TEST(Dimming, TakesTheLightThatAnObjectHides) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        const Mesh block = box(glm::vec3(-0.5f), glm::vec3(0.5f), false);
        const glm::mat4 turned =
            glm::rotate(moved({1.5f, 1.1f, 2.2f}), 0.6f, glm::normalize(glm::vec3(1, 2, 0.5f)));
        for (const auto& [mesh, at] :
             {std::pair(block, moved({2, 1, 2.5f})),
              std::pair(block, glm::scale(turned, glm::vec3(1.2f, 0.4f, 1))),
              std::pair(sphere(0.6f, 3, false), moved({2, 1.2f, 3}))}) {
            const Errors e = errors(room(mesh, at, storage));
            std::printf("storage %d: mean error %.4f, most %.3f; undimmed %.4f\n", int(storage),
                        e.mean, e.most, e.undimmed);
            EXPECT_GT(e.undimmed, 0.02);
            EXPECT_LT(e.mean, e.undimmed / 10);
            EXPECT_LT(e.most, 0.04);
        }
    }
}

TEST(Dimming, WithoutDynamicObjectsOrFarFromThemNothingIsDone) {
    Scene scene = room(box(glm::vec3(0), glm::vec3(0.02f), false), moved({2, 1.5f, 2.5f}));
    const auto bake = baked(scene);
    Relighter relighter(bake);
    const RelightStats small = relighter.relight(scene, TraceScene(scene), 8);
    EXPECT_GT(small.dimMs, 0);
    EXPECT_EQ(small.cachesDimmed, 0U); // it is 1.5 m away from all, over 22 of its radii
    scene.instances[1].toWorld = moved({2, 0, 2.5f}); // on the floor
    EXPECT_GT(relighter.relight(scene, TraceScene(scene), 8).cachesDimmed, 0U);
    const RelightStats still = relighter.relight(scene, TraceScene(scene), 8);
    EXPECT_EQ(still.dimMs, 0);
    EXPECT_TRUE(still.skipped);
    scene.bake.dimming = false;
    const RelightStats off = relighter.relight(scene, TraceScene(scene), 8);
    EXPECT_FALSE(off.skipped);
    EXPECT_EQ(off.cachesDimmed, 0U);
    EXPECT_EQ(off.linksDimmed, 0U);

    Scene empty = scene;
    empty.instances.pop_back();
    empty.bake.dimming = true;
    Relighter first(bake), second(bake);
    const RelightStats none = first.relight(empty, TraceScene(empty), 8);
    EXPECT_EQ(none.dimMs, 0);
    EXPECT_EQ(none.cachesDimmed, 0U);
    empty.bake.dimming = false;
    second.relight(empty, TraceScene(empty), 8);
    EXPECT_TRUE(first.cacheSh() == second.cacheSh());
}

TEST(Dimming, FollowsAnObjectAsIfItHadAlwaysBeenThere) {
    const Mesh block = box(glm::vec3(-0.4f), glm::vec3(0.4f), false);
    Scene scene = room(block, moved({1, 0.8f, 1}));
    const auto bake = baked(scene);
    Relighter relighter(bake), other(bake);
    relighter.relight(scene, TraceScene(scene), 8);
    const std::vector<glm::vec3> before = relighter.cacheSh();
    scene.instances[1].toWorld = moved({2.5f, 1.5f, 3});
    const TraceScene there(scene);
    relighter.relight(scene, there, 8);
    {
        const ThreadLimit alone(1);
        other.relight(scene, there, 8);
    }
    EXPECT_FALSE(relighter.cacheSh() == before);
    EXPECT_TRUE(relighter.cacheSh() == other.cacheSh()); // no albedo: nothing to converge
    scene.instances[1].toWorld = moved({1, 0.8f, 1});
    relighter.relight(scene, TraceScene(scene), 8);
    EXPECT_TRUE(relighter.cacheSh() == before);
}

TEST(Dimming, ACacheWithinAnObjectSeesNothingAndNoLightIsNegative) {
    Scene scene = room(box(glm::vec3(-0.8f), glm::vec3(0.8f), false), moved({2, 0.5f, 2.5f}));
    scene.sky.radiance = glm::vec3(1);
    const auto bake = baked(scene);
    Relighter relighter(bake);
    relighter.relight(scene, TraceScene(scene), 8);
    const Caches& c = bake->caches;
    std::uint32_t within = 0;
    for (std::uint32_t i = 0; i < c.lightmapCount; ++i) {
        const glm::vec3* sh = relighter.cacheSh().data() + 9 * i;
        EXPECT_GE(sh[0].x, 0) << i;
        if (c.position[i].y == 0 && std::abs(c.position[i].x - 2) < 0.75f &&
            std::abs(c.position[i].z - 2.5f) < 0.75f) {
            EXPECT_EQ(sh[0], glm::vec3(0)) << i;
            ++within;
        }
    }
    EXPECT_GT(within, 10U);
}

TEST(Dimming, LeavesSmallerTransportsAndLinksOfTheSameCaches) {
    const Scene scene = room(box(glm::vec3(-0.5f), glm::vec3(0.5f), false), moved({2, 1, 2.5f}));
    const auto bake = baked(scene);
    BlockerShapes shapes;
    const DimmedLinks dimmed =
        dimLinks(*bake, senderPlaces(bake->surfels, bake->tree), sceneBlockers(scene, shapes));
    ASSERT_FALSE(dimmed.cache.empty());
    EXPECT_TRUE(std::is_sorted(dimmed.cache.begin(), dimmed.cache.end()));
    EXPECT_LT(dimmed.cache.size(), bake->caches.size());
    std::uint64_t lower = 0;
    for (std::size_t i = 0; i < dimmed.cache.size(); ++i) {
        const std::uint32_t c = dimmed.cache[i];
        std::uint32_t own = bake->caches.linkBegin[c];
        lower += bake->caches.linkBegin[c + 1] - own;
        for (std::uint32_t k = dimmed.links.linkBegin[i]; k < dimmed.links.linkBegin[i + 1]; ++k) {
            const Link link = dimmed.links.links[k];
            while (bake->caches.links[own].node != link.node)
                ++own; // in the same order; those wholly blocked are missing
            ASSERT_LT(own, bake->caches.linkBegin[c + 1]);
            EXPECT_LE(link.transport, bake->caches.links[own].transport); // halfs order as integers
            lower -= link.transport == bake->caches.links[own].transport ? 1 : 0;
        }
    }
    EXPECT_EQ(lower, dimmed.dimmed);
}

TEST(BlockerShape, IsABoxForABoxAndTrianglesForOthers) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0)));
    for (const Mesh& mesh : {box({-1, -2, -3}, {1, 2, 3}, false), sphere(1, 2, false),
                             quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0})})
        b.add(mesh);
    Mesh open = box(glm::vec3(0), glm::vec3(1), false);
    open.indices.resize(30); // without its last side
    b.add(open);
    Mesh turned = box(glm::vec3(0), {1, 2, 3}, false);
    const glm::mat3 turn(glm::rotate(glm::mat4(1), 0.7f, glm::normalize(glm::vec3(1, 2, 3))));
    for (glm::vec3& p : turned.positions)
        p = turn * (p + glm::vec3(4, 5, 6));
    b.add(turned);
    const Scene scene = b.build();
    EXPECT_FALSE(blockerShape(scene, 0).triangles);
    EXPECT_NEAR(glm::length(blockerShape(scene, 0).box.size()), glm::length(glm::vec3(2, 4, 6)),
                1e-5f);
    for (const std::uint32_t mesh : {1U, 2U, 3U})
        EXPECT_TRUE(blockerShape(scene, mesh).triangles) << mesh;
    const BlockerShape box = blockerShape(scene, 4);
    EXPECT_FALSE(box.triangles);
    EXPECT_NEAR(glm::length(box.box.size()), glm::length(glm::vec3(1, 2, 3)), 1e-4f);
}

TEST(Block, BeginsAtTheBoxAndBeforeTheLightsOrigin) {
    const Scene scene = room(box(glm::vec3(0), glm::vec3(1), false), moved({1, 1, 1}));
    BlockerShapes shapes;
    const Blocker blocker = sceneBlockers(scene, shapes)[0];
    const auto blocked = [&](glm::vec3 from, glm::vec3 d, float tMost) {
        ConeSamples samples;
        samples.count = 4;
        for (std::size_t k = 0; k < 4; ++k) {
            samples.x[k] = d.x, samples.y[k] = d.y, samples.z[k] = d.z;
            samples.tMost[k] = k == 0 ? 0.f : tMost;
            samples.blocked[k] = false;
        }
        block(blocker, from, samples);
        EXPECT_FALSE(samples.blocked[0]);
        return samples.blocked[3];
    };
    const glm::vec3 up(0, 1, 0);
    EXPECT_TRUE(blocked({1.5f, 0, 1.5f}, up, 1.1f));
    EXPECT_FALSE(blocked({1.5f, 0, 1.5f}, up, 0.9f)); // it begins behind the light's origin
    EXPECT_FALSE(blocked({1.5f, 0, 1.5f}, -up, 9));
    EXPECT_FALSE(blocked({2.5f, 0, 1.5f}, up, 9));
    EXPECT_TRUE(blocked({1.5f, 1.5f, 1.5f}, up, 9)); // from within
    EXPECT_FALSE(blocked({1.5f, 2, 1.5f}, up, 9));   // from its top, away
    EXPECT_TRUE(blocked({1.5f, 2, 1.5f}, -up, 9));
}

TEST(SceneBlockers, LeaveStaticAndFlattenedInstancesOut) {
    const Mesh block = box(glm::vec3(0), glm::vec3(1), false);
    Scene scene = room(block, moved({1, 1, 1}));
    BlockerShapes shapes;
    ASSERT_EQ(sceneBlockers(scene, shapes).size(), 1U);
    const Blocker blocker = sceneBlockers(scene, shapes)[0];
    EXPECT_LT(glm::distance(blocker.bounds.lower, glm::vec3(1)), 1e-5f);
    EXPECT_LT(glm::distance(blocker.bounds.upper, glm::vec3(2)), 1e-5f);
    EXPECT_LT(glm::distance(blocker.centre, glm::vec3(1.5f)), 1e-5f);
    EXPECT_NEAR(blocker.radius, std::sqrt(0.75f), 1e-5f);
    EXPECT_NE(hashBlockers(scene), 0U);
    scene.instances[1].toWorld[1] = glm::vec4(0);
    EXPECT_TRUE(sceneBlockers(scene, shapes).empty());
    EXPECT_TRUE(dimsLinks(scene));
    scene.bake.dimming = false;
    EXPECT_FALSE(dimsLinks(scene));
    scene.bake.dimming = true;
    scene.instances[1].dynamic = false;
    EXPECT_FALSE(dimsLinks(scene));
    EXPECT_EQ(hashBlockers(scene), 0U);
}

} // namespace
} // namespace limn
