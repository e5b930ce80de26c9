// SPDX-License-Identifier: MIT
#include "engine/math/sampling.h"
#include "engine/techniques/probes/march_ray.h"
#include "engine/techniques/probes/probe_planes.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace limn::marched_rooms_test {
namespace {

/// The maps that the probes of a grid trace of a scene, black.
MarchedMaps tracedMaps(const Scene& scene, const TraceScene& trace, const ProbeGrid& grid,
                       std::uint32_t side) {
    ProbeMaps seen = emptyMaps(grid, side);
    MarchedMaps maps = emptyMarchedMaps(grid.size, grid.bounds, side);
    for (std::uint32_t p = 0; p < grid.count(); ++p) {
        traceProbe(scene, trace, p, seen);
        writePlanes(scene, seen, p, maps);
    }
    return maps;
}

/// How marched rays compare with traced ones.
struct Compared {
    int rays = 0, within = 0; ///< two texels of what the probe sees
    int unknown = 0, missed = 0;
};

/// Rays from points of surfaces that face `inside`, as reflections start.
Compared compare(const Scene& scene, const ProbeGrid& grid, std::uint32_t side) {
    const TraceScene trace(scene);
    const MarchedMaps maps = tracedMaps(scene, trace, grid, side);
    const float texel = 2 * std::sqrt(std::numbers::pi_v<float>) / float(side);
    const DirectionSet ways(4000, true, 7), starts(4000, true, 3);
    Compared found;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        const glm::vec3 from = grid.position(mixBits(i) % grid.count());
        const Hit start = trace.closestHit({from, starts[mixBits(i + 5) % 4000]});
        if (!start || !start.frontFace)
            continue;
        const glm::vec3 o = trace.clearOf(start.position, start.geometricNormal);
        glm::vec3 d = ways[i];
        d *= glm::dot(d, start.geometricNormal) < 0 ? -1.f : 1.f;
        const Hit exact = trace.closestHit({o, d});
        const MarchedRay ray = marchRay(maps, o, d);
        ++found.rays;
        found.unknown += ray.end == MarchEnd::Unknown ? 1 : 0;
        found.missed += exact && ray.end == MarchEnd::Miss ? 1 : 0;
        if (!exact || ray.end != MarchEnd::Hit)
            continue;
        const float seenFrom = glm::distance(grid.position(ray.probe), exact.position);
        found.within += std::abs(ray.t - exact.t) <= 2 * texel * seenFrom ? 1 : 0;
    }
    return found;
}

Scene boxRoom(float scale = 1) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true),
          glm::scale(glm::mat4(1), glm::vec3(scale)));
    return b.build();
}

TEST(MarchedRooms, OneProbeKnowsAllOfAConvexRoom) {
    for (const float scale : {1e-3f, 1.f, 1e3f}) {
        const Scene scene = boxRoom(scale);
        for (const std::uint32_t side : {16U, 48U, 128U}) {
            const Compared found = compare(scene, {scene.bounds, glm::uvec3(1)}, side);
            EXPECT_EQ(found.rays, 4000);
            EXPECT_EQ(found.unknown, 0) << side << ", " << scale;
            EXPECT_EQ(found.missed, 0) << side << ", " << scale;
            EXPECT_GT(found.within, 0.95 * found.rays) << side << ", " << scale;
        }
    }
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::sphere(2, 4, true));
    const Scene sphere = b.build();
    const Compared round = compare(sphere, {sphere.bounds, glm::uvec3(1)}, 64);
    EXPECT_GT(round.within, 0.95 * round.rays);
    EXPECT_EQ(round.unknown, 0);
}

TEST(MarchedRooms, NearlyAllRaysInARoomWithThingsEndWhereTheyShould) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false));
    b.add(simple::sphere(0.6f, 3, false), glm::translate(glm::mat4(1), {3, 0.7f, 3}));
    const Scene scene = b.build();
    for (const std::uint32_t side : {48U, 128U}) {
        const Compared found = compare(scene, {scene.bounds, glm::uvec3(3, 2, 4)}, side);
        EXPECT_GT(found.within, 0.95 * found.rays) << side;
        EXPECT_LT(found.unknown, 0.01 * found.rays) << side;
        EXPECT_EQ(found.missed, 0) << side;
        std::printf("%u texels a side: %.2f %% within two texels, %.2f %% unknown\n", side,
                    100. * found.within / found.rays, 100. * found.unknown / found.rays);
    }
}

/// A room 4 m wide with a pillar in its middle, seen by two probes to the left and the right.
struct Pillar {
    Scene scene;
    ProbeGrid grid;
    MarchedMaps maps;

    explicit Pillar(glm::uvec3 probes) {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.5f)));
        b.add(simple::box(glm::vec3(-2, 0, -2), glm::vec3(2, 3, 2), true));
        b.add(simple::box({-0.3f, 0, -0.3f}, {0.3f, 3, 0.3f}, false));
        scene = b.build();
        grid = {scene.bounds, probes};
        maps = tracedMaps(scene, TraceScene(scene), grid, 64);
    }
};

TEST(MarchedRooms, WhatAPillarHidesFromOneProbeTheNextOneKnows) {
    const Pillar room({2, 1, 1});
    ASSERT_EQ(room.grid.position(0), glm::vec3(-1, 1.5f, 0));
    const glm::vec3 o(-1.5f, 1.2f, -1.9f), d = glm::normalize(glm::vec3(1.2f, 0, 1.9f));
    const MarchedRay left = marchProbe(room.maps, 0, o, d, 0);
    EXPECT_EQ(left.end, MarchEnd::Hit) << "the side of the pillar that the probe sees";
    EXPECT_NEAR(left.t, 1.2f / d.x, 0.05f);
    const glm::vec3 along(0, 0, 1), behind(1, 1.2f, -1.9f);
    const MarchedRay hidden = marchProbe(room.maps, 0, behind, along, 0);
    EXPECT_EQ(hidden.end, MarchEnd::Unknown);
    EXPECT_GT(hidden.t, 0.5f) << "up to there, the probe sees the ray beside the pillar";
    EXPECT_LT(hidden.t, 1.9f);
    const glm::vec3 near(-0.05f, 1.2f, -1.9f), right = glm::normalize(glm::vec3(0.45f, 0, 1));
    EXPECT_EQ(marchProbe(room.maps, 0, near, right, 0).end, MarchEnd::Unknown);
    const MarchedRay next = marchRay(room.maps, near, right);
    EXPECT_EQ(next.end, MarchEnd::Hit);
    EXPECT_EQ(next.probe, 1U);
    const Hit exact = TraceScene(room.scene).closestHit({near, right});
    EXPECT_NEAR(next.t, exact.t, 0.1f);
}

TEST(MarchedRooms, WhatNoProbeSeesIsUnknownAndReadsTheNearestAlongTheRay) {
    Pillar room(glm::uvec3(1));
    // The only probe would stand in the pillar: move it to the left end of the room.
    room.grid = {{glm::vec3(-2.8f, 0, -2), glm::vec3(0, 3, 2)}, glm::uvec3(1)};
    room.maps = tracedMaps(room.scene, TraceScene(room.scene), room.grid, 64);
    for (std::uint32_t t = 0; t < room.maps.texels(); ++t)
        room.maps.radiance[0][t] = Octahedron{64}.direction(t);
    updateLevels(room.maps, 0);
    const glm::vec3 o(1.5f, 1.2f, -0.2f), d = glm::normalize(glm::vec3(0.1f, 0.2f, 1));
    const MarchedRay ray = marchRay(room.maps, o, d);
    EXPECT_EQ(ray.end, MarchEnd::Unknown);
    EXPECT_EQ(ray.probe, 0U);
    EXPECT_LT(ray.t, TraceScene(room.scene).closestHit({o, d}).t);
    EXPECT_LT(glm::distance(marchedRadiance(room.maps, lookUp(room.maps, ray, o, d, 0)), d), 0.05f);
}

} // namespace
} // namespace limn::marched_rooms_test
