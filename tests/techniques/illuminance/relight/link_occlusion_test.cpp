// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/occlusion/link_occlusion.h"

#include "engine/core/parallel.h"
#include "engine/math/packing.h"
#include "engine/math/sampling.h"
#include "engine/math/sh.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/relight/occlusion/link_cone.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "tests/techniques/illuminance/shared_bake.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/vector_relational.hpp>

namespace limn::link_occlusion_test {
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
    return sharedBake(TraceScene(scene));
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
    double mean = 0, unoccluded = 0, most = 0; ///< of the irradiance of caches, over pi
};

Errors errors(const Scene& scene, const std::shared_ptr<const Bake>& bake) {
    const TraceScene trace(scene);
    Relighter relighter(bake);
    relighter.relight(scene, trace, 8);
    const Caches& c = bake->caches;
    Errors e;
    for (std::uint32_t i = 0; i < c.lightmapCount; ++i) {
        const float open = openShare(trace, c.position[i], c.normal[i]);
        const float is = shIrradiance(3, relighter.cacheSh().data() + 9 * i, c.normal[i]).x / kPi;
        EXPECT_TRUE(std::isfinite(is));
        e.mean += std::abs(double(is - open)) / c.lightmapCount;
        e.unoccluded += double(1 - open) / c.lightmapCount;
        e.most = std::max(e.most, std::abs(double(is - open)));
    }
    return e;
}

TEST(LinkOcclusion, TakesTheLightThatAnObjectHides) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        const Mesh block = box(glm::vec3(-0.5f), glm::vec3(0.5f), false);
        const auto bake = baked(room(block, moved({2, 1, 2.5f}), storage));
        const glm::mat4 turned =
            glm::rotate(moved({1.5f, 1.1f, 2.2f}), 0.6f, glm::normalize(glm::vec3(1, 2, 0.5f)));
        for (const auto& [mesh, at] :
             {std::pair(block, moved({2, 1, 2.5f})),
              std::pair(block, glm::scale(turned, glm::vec3(1.2f, 0.4f, 1))),
              std::pair(sphere(0.6f, 3, false), moved({2, 1.2f, 3}))}) {
            const Errors e = errors(room(mesh, at, storage), bake);
            std::printf("storage %d: mean error %.4f, most %.3f; unoccluded %.4f\n", int(storage),
                        e.mean, e.most, e.unoccluded);
            EXPECT_GT(e.unoccluded, 0.02);
            EXPECT_LT(e.mean, e.unoccluded / 10);
            EXPECT_LT(e.most, 0.04);
        }
    }
}

TEST(LinkOcclusion, WithoutDynamicObjectsOrFarFromThemNothingIsDone) {
    Scene scene = room(box(glm::vec3(0), glm::vec3(0.02f), false), moved({2, 1.5f, 2.5f}));
    const auto bake = baked(scene);
    Relighter relighter(bake);
    const RelightStats small = relighter.relight(scene, TraceScene(scene), 8);
    EXPECT_GT(small.occlusionMs, 0);
    EXPECT_EQ(small.cachesOccluded, 0U); // it is 1.5 m away from all, over 22 of its radii
    scene.instances[1].toWorld = moved({2, 0, 2.5f}); // on the floor
    EXPECT_GT(relighter.relight(scene, TraceScene(scene), 8).cachesOccluded, 0U);
    const RelightStats still = relighter.relight(scene, TraceScene(scene), 8);
    EXPECT_EQ(still.occlusionMs, 0);
    EXPECT_TRUE(still.skipped);
    scene.relight.dynamicOcclusion = false;
    const RelightStats off = relighter.relight(scene, TraceScene(scene), 8);
    EXPECT_FALSE(off.skipped);
    EXPECT_EQ(off.cachesOccluded, 0U);
    EXPECT_EQ(off.linksOccluded, 0U);

    Scene empty = scene;
    empty.instances.pop_back();
    empty.relight.dynamicOcclusion = true;
    Relighter first(bake), second(bake);
    const RelightStats none = first.relight(empty, TraceScene(empty), 8);
    EXPECT_EQ(none.occlusionMs, 0);
    EXPECT_EQ(none.cachesOccluded, 0U);
    empty.relight.dynamicOcclusion = false;
    second.relight(empty, TraceScene(empty), 8);
    EXPECT_TRUE(first.cacheSh() == second.cacheSh());
}

TEST(LinkOcclusion, FollowsAnObjectAsIfItHadAlwaysBeenThere) {
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

TEST(LinkOcclusion, ACacheWithinAnObjectSeesNothingAndNoLightIsNegative) {
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

struct Occluded {
    std::shared_ptr<const Bake> bake;
    std::vector<Blocker> blockers;
    LinkOcclusion occlusion;
    OccludedLinks links;
};

Occluded occluded(const Scene& scene, std::shared_ptr<const Bake> bake) {
    Occluded d{.bake = std::move(bake)};
    updateLinkOcclusion(*d.bake, scene, d.occlusion);
    d.blockers = sceneBlockers(scene, d.occlusion.shapes);
    occludeLinks(*d.bake, d.occlusion, {}, d.links);
    return d;
}

Occluded occluded(const Scene& scene) {
    return occluded(scene, baked(scene));
}

TEST(LinkOcclusion, LowersTheTransportsOfHiddenLinksAndNoOthers) {
    const Occluded d =
        occluded(room(box(glm::vec3(-0.5f), glm::vec3(0.5f), false), moved({2, 1, 2.5f})));
    const std::vector<Link>&before = d.bake->caches.links, &now = d.links.cones.links;
    ASSERT_EQ(now.size(), before.size());
    std::uint64_t lower = 0, gone = 0;
    for (std::size_t k = 0; k < now.size(); ++k) {
        const int hidden = std::popcount(d.occlusion.hidden.directions[k]);
        const auto all = int(directionsOf(halfToFloat(before[k].u)));
        ASSERT_LE(hidden, all);
        EXPECT_NEAR(halfToFloat(now[k].transport),
                    halfToFloat(before[k].transport) * (1 - float(hidden) / float(all)),
                    halfToFloat(before[k].transport) * 0x1p-11f);
        lower += hidden > 0 ? 1 : 0;
        gone += now[k].transport == 0 ? 1 : 0;
        Link same = now[k];
        same.transport = before[k].transport;
        ASSERT_EQ(same, before[k]);
    }
    EXPECT_EQ(lower, d.occlusion.hidden.links);
    EXPECT_GT(gone, 0U);
    EXPECT_LT(gone, lower);
    EXPECT_GT(d.occlusion.hidden.caches, 0U);
    EXPECT_LT(d.occlusion.hidden.caches, d.bake->caches.size());
}

TEST(LinkOcclusion, OfFewerBandsThanLinksHaveIsTheSame) {
    Scene scene =
        room(box(glm::vec3(-0.5f), glm::vec3(0.5f), false), moved({2, 1, 2.5f}), LinkStorage::Sh);
    scene.bake.bands = 5;
    const auto bake = baked(scene);
    const TraceScene trace(scene);
    Relighter few(bake), all(bake, LitBands::All);
    EXPECT_EQ(few.relight(scene, trace, 8).bandsLit, 3U);
    const RelightStats stats = all.relight(scene, trace, 8);
    EXPECT_EQ(stats.bandsLit, 5U);
    EXPECT_GT(stats.linksOccluded, 0U);
    for (std::size_t c = 0; c < bake->caches.size(); ++c)
        for (std::size_t i = 0; i < 9; ++i)
            ASSERT_LT(glm::distance(few.cacheSh()[c * 9 + i], all.cacheSh()[c * 25 + i]), 1e-4f);
}

bool holds(const BlockerShape& shape, glm::vec3 p) {
    return shape.closed && std::ranges::all_of(shape.sides, [&](const BlockerShape::Side& s) {
               return glm::dot(s.normal, p) < s.offset;
           });
}

struct Differences {
    std::uint64_t directions = 0, blocked = 0, other = 0;
};

/// Asks a ray of every direction of every link, whatever is in its way.
Differences compareWithRays(const Scene& scene, const Occluded& d) {
    const TraceScene trace(scene);
    const Caches& c = d.bake->caches;
    const Blocker& blocker = d.blockers[0];
    const auto coefficients = std::size_t(d.bake->settings.bands * d.bake->settings.bands);
    const glm::vec3 cell = d.bake->gridBounds.size() / glm::vec3(d.bake->gridSize);
    Differences result;
    for (std::uint32_t i = 0; i < c.size(); ++i) {
        const glm::vec3 x = c.position[i], toMiddle = blocker.centre - x;
        const glm::vec3 beyond = glm::max(blocker.bounds.lower - x, x - blocker.bounds.upper);
        const bool own = c.kind[i] == CacheKind::Grid && glm::all(glm::lessThan(beyond, cell));
        const float sine = std::min(blocker.radius / glm::length(toMiddle), 1.f);
        if (own || 1 - std::sqrt(1 - sine * sine) < 1.01f * kMinBlocked)
            continue;
        const bool within = holds(*blocker.shape, blocker.toObject * (x - blocker.origin));
        for (std::uint32_t k = c.linkBegin[i]; k < c.linkBegin[i + 1]; ++k) {
            LinkCone cone;
            if (c.shNode.empty())
                cone = {c.links[k].node, unpackOct(c.links[k].octX, c.links[k].octY),
                        halfToFloat(c.links[k].u)};
            else
                cone = coneOfHarmonics(c, k, coefficients);
            const DirectionSet set(directionsOf(cone.u), false, 0);
            const glm::mat3 toWorld = basisAround(glm::normalize(cone.direction));
            const SenderPlace& place = d.occlusion.places[cone.node];
            const float distance = glm::distance(place.centre, x);
            for (std::uint32_t n = 0; n < set.count; ++n) {
                glm::vec3 w = set[n];
                const glm::vec2 around = glm::normalize(glm::vec2(w));
                w.z = 1 - cone.u * (1 - w.z);
                w = toWorld * glm::vec3(around * std::sqrt(std::max(1 - w.z * w.z, 0.f)), w.z);
                float from = distance + place.radius;
                if (place.normal != glm::vec3(0)) {
                    const float along = glm::dot(place.normal, w);
                    from = std::abs(along) > 0.02f
                               ? glm::dot(place.normal, place.centre - x) / along
                               : distance;
                    from = std::clamp(from, distance - place.radius, distance + place.radius);
                }
                const bool hit = from > 0 && (within || trace.occluded({x, w, 0, 0.999f * from},
                                                                       TraceMask::Dynamic));
                ++result.directions;
                result.blocked += hit ? 1 : 0;
                result.other += hit != ((d.occlusion.hidden.directions[k] >> n & 1U) != 0) ? 1 : 0;
            }
        }
    }
    return result;
}

Mesh withoutSide(Mesh box) {
    box.indices.resize(30);
    return box;
}

/// A wedge: its top is askew.
Mesh wedge() {
    Mesh m = box(glm::vec3(-0.5f), glm::vec3(0.5f), false);
    for (glm::vec3& p : m.positions)
        if (p.y > 0)
            p.y += 0.4f * p.x;
    return m;
}

/// Two boxes in one mesh.
Mesh pair() {
    Mesh m = box(glm::vec3(-0.5f), glm::vec3(-0.1f), false);
    const Mesh other = box(glm::vec3(0.1f), glm::vec3(0.5f), false);
    for (const std::uint32_t i : other.indices)
        m.indices.push_back(i + std::uint32_t(m.positions.size()));
    m.positions.insert(m.positions.end(), other.positions.begin(), other.positions.end());
    m.normals.insert(m.normals.end(), other.normals.begin(), other.normals.end());
    return m;
}

// At outlines one rounding or another may miss: in a ten-thousandth of what is blocked.
TEST(HiddenLinks, AreThoseOfWhichRaysFindTheObjectInTheWay) {
    const Mesh block = box(glm::vec3(-0.5f), glm::vec3(0.5f), false);
    const glm::mat4 turned = glm::scale(
        glm::rotate(moved({1.5f, 1.1f, 2.2f}), 0.6f, glm::normalize(glm::vec3(1, 2, 0.5f))),
        glm::vec3(1.2f, 0.4f, 1));
    // A dynamic object has no part in a bake, so one of each storage serves all of them.
    const std::array<std::shared_ptr<const Bake>, 2> bakes = {
        baked(room(block, moved({2, 1, 2.5f}), LinkStorage::Rtp)),
        baked(room(block, moved({2, 1, 2.5f}), LinkStorage::Sh))};
    for (const auto& [name, mesh] :
         {std::pair("box", block), std::pair("open box", withoutSide(block)),
          std::pair("wedge", wedge()), std::pair("sphere", sphere(0.6f, 3, false)),
          std::pair("pair", pair()),
          std::pair("sheet", quad({-0.5f, 0, -0.5f}, {1, 0, 0}, {0, 0, 1}))})
        for (const auto& [at, storage] :
             {std::pair(moved({2, 1, 2.5f}), LinkStorage::Rtp),
              std::pair(moved({2, 0.3f, 2.5f}), LinkStorage::Rtp),
              std::pair(turned, LinkStorage::Rtp), std::pair(turned, LinkStorage::Sh)}) {
            const Scene scene = room(mesh, at, storage);
            const Differences d =
                compareWithRays(scene, occluded(scene, bakes[std::size_t(storage)]));
            std::printf("%s, storage %d: %llu of %llu directions blocked, %llu differ\n", name,
                        int(storage), static_cast<unsigned long long>(d.blocked),
                        static_cast<unsigned long long>(d.directions),
                        static_cast<unsigned long long>(d.other));
            EXPECT_GT(d.blocked, d.directions / 1000) << name;
            EXPECT_LE(d.other, d.blocked / 10000) << name;
        }
}

TEST(HiddenLinks, AreFoundThroughConesTooNarrowForNormalHalfs) {
    const Scene scene = room(sphere(0.6f, 3, false), moved({2, 1, 2.5f}));
    Bake bake = *baked(scene);
    for (Link& link : bake.caches.links)
        link.u = 0x3ff; // 6.1e-5, the largest denormal: a half-angle of 0.6 degrees
    const Differences d =
        compareWithRays(scene, occluded(scene, std::make_shared<const Bake>(std::move(bake))));
    EXPECT_GT(d.blocked, d.directions / 1000);
    EXPECT_LE(d.other, d.blocked / 10000);
}

std::size_t sidesThere(const BlockerShape& shape) {
    return std::size_t(std::ranges::count_if(shape.sides, &BlockerShape::Side::there));
}

TEST(BlockerShape, IsTheSidesOfAConvexMeshAndTrianglesOfOthers) {
    const Mesh whole = box({-1, -2, -3}, {1, 2, 3}, false);
    Mesh tunnel = whole, inverted = whole;
    tunnel.indices.resize(24); // without two sides
    for (std::size_t i = 0; i < inverted.indices.size(); i += 3)
        std::swap(inverted.indices[i], inverted.indices[i + 1]);
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0)));
    for (const Mesh& mesh : {whole, wedge(), inverted, withoutSide(whole), sphere(1, 2, false),
                             pair(), tunnel, quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0})})
        b.add(mesh);
    const Scene scene = b.build();
    for (const std::uint32_t mesh : {0U, 1U, 2U}) {
        const BlockerShape shape = blockerShape(scene, mesh);
        EXPECT_FALSE(shape.triangles) << mesh;
        EXPECT_TRUE(shape.closed) << mesh;
        EXPECT_EQ(sidesThere(shape), 6U) << mesh;
    }
    const BlockerShape open = blockerShape(scene, 3);
    EXPECT_FALSE(open.triangles);
    EXPECT_FALSE(open.closed);
    EXPECT_EQ(open.sides.size(), 6U);
    EXPECT_EQ(sidesThere(open), 5U);
    for (const BlockerShape::Side& side : open.sides) { // the box's, whichever is missing
        const glm::vec3 n = glm::abs(side.normal);
        EXPECT_NEAR(side.offset, glm::dot(n, glm::vec3(1, 2, 3)), 1e-5f);
        EXPECT_NEAR(std::max({n.x, n.y, n.z}), 1, 1e-6f);
    }
    const BlockerShape ball = blockerShape(scene, 4);
    EXPECT_TRUE(ball.triangles);
    EXPECT_GT(ball.innerBall, 0.8f);
    EXPECT_LT(ball.innerBall, 1);
    EXPECT_NEAR(ball.outerBall, 1, 1e-3f);
    for (const std::uint32_t mesh : {5U, 6U, 7U}) { // the middle of its box is not within
        const BlockerShape shape = blockerShape(scene, mesh);
        EXPECT_TRUE(shape.triangles) << mesh;
        EXPECT_EQ(shape.innerBall, 0) << mesh;
    }
}

TEST(SceneBlockers, HaveTheSphereAboutTheMeshUnlessItIsSquashed) {
    BlockerShapes shapes;
    const Mesh ball = sphere(0.6f, 3, false);
    const glm::mat4 turned =
        glm::rotate(moved({1, 1, 1}), 0.7f, glm::normalize(glm::vec3(1, 2, 3)));
    const auto radius = [&](const glm::mat4& at) {
        return sceneBlockers(room(ball, at), shapes)[0].radius;
    };
    EXPECT_NEAR(radius(turned), 0.6f, 2e-3f);
    EXPECT_NEAR(radius(glm::scale(turned, glm::vec3(0.5f))), 0.3f, 1e-3f);
    EXPECT_GE(radius(glm::scale(turned, glm::vec3(1, 1.2f, 1))), 0.72f);
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
    EXPECT_TRUE(occludesLinks(scene));
    scene.relight.dynamicOcclusion = false;
    EXPECT_FALSE(occludesLinks(scene));
    scene.relight.dynamicOcclusion = true;
    scene.instances[1].dynamic = false;
    EXPECT_FALSE(occludesLinks(scene));
    EXPECT_EQ(hashBlockers(scene), 0U);
}

} // namespace
} // namespace limn::link_occlusion_test
