// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/transport.h"

#include "engine/math/packing.h"
#include "engine/math/sh.h"
#include "engine/techniques/sparse_probes/relight_rays.h"
#include "engine/techniques/sparse_probes/sparse_gather.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace limn::transport_test {
namespace {

constexpr double kPi = std::numbers::pi;

/// A texel with one point, in the middle of the first triangle of an instance.
AtlasTexel texelOf(std::uint32_t instance, glm::vec2 barycentric) {
    AtlasTexel texel{};
    texel.instance = instance;
    texel.count = 1;
    texel.points[0] = {0, barycentric};
    return texel;
}

/// A square of 2 m that faces up, its middle in the origin, alone below the sky.
Scene square() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
    return b.build();
}

TEST(NearProbes, AreTheEightNearestWithWeightsUpToTheNinth) {
    std::vector<glm::vec3> probes;
    for (int i = 12; i > 0; --i)
        probes.emplace_back(float(i), 0, 0);
    const NearProbes near = nearestProbes(probes, glm::vec3(0));
    for (std::uint32_t k = 0; k < kProbesPerReceiver; ++k) {
        EXPECT_EQ(near.probe[k], 11 - k);
        const double t = (k + 1) / 9.;
        EXPECT_NEAR(near.weight[k], 2 * t * t * t - 3 * t * t + 1, 1e-6);
    }
    const NearProbes two = nearestProbes(std::span(probes).first(2), glm::vec3(0));
    EXPECT_EQ(two.probe[0], 1);
    EXPECT_EQ(two.probe[2], kNoProbe);
    EXPECT_GT(two.weight[1], 0);
    EXPECT_EQ(two.weight[2], 0);
    EXPECT_EQ(nearestProbes({}, glm::vec3(0)).probe[0], kNoProbe);
    const NearProbes same = nearestProbes(std::vector(3, glm::vec3(1)), glm::vec3(1));
    EXPECT_GT(same.weight[0], 0);
    EXPECT_EQ(same.weight[2], same.weight[0]);
}

TEST(Transport, OfAProbeAtTheReceiverIsTheClampedCosine) {
    const TraceScene trace(square());
    const std::vector<AtlasTexel> texels = {texelOf(0, {0, 0.5f})};
    const glm::vec3 at(0, trace.epsilonAt(glm::vec3(0)), 0);
    const Transport t = traceTransport(trace, texels, std::vector{at}, {.rays = 4096});
    const auto factors = irradianceFactors();
    float y[16];
    shBasis(4, {0, 1, 0}, y);
    for (int l = 0; l < 4; ++l)
        for (int m = -l; m <= l; ++m) {
            const auto i = std::size_t(l * (l + 1) + m);
            EXPECT_NEAR(halfToFloat(t.coefficients[i]), factors[std::size_t(l)] * y[i], 5e-3)
                << l << ", " << m;
        }
    EXPECT_EQ(t.unseen[0], 0);
}

TEST(Transport, TurnsTowardsWhatTheReceiverSees) {
    // A ceiling 1 m above the square, and a probe 0.5 m aside of the receiver: the harmonics of the
    // point above the receiver are those of the direction from the probe.
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
    b.add(simple::quad({-9, 1, -9}, {18, 0, 0}, {0, 0, 18}));
    const Scene scene = b.build();
    const TraceScene trace(scene);
    const std::vector<AtlasTexel> texels = {texelOf(0, {0, 0.5f})};
    const glm::vec3 probe(0.5f, 0.5f, 0);
    const Transport t = traceTransport(trace, texels, std::vector{probe}, {.rays = 4096});
    // First band along x: sqrt(3 / 4 pi) times the integral of cosine times the direction's x.
    double expected = 0;
    constexpr int kSteps = 400;
    for (int i = 0; i < kSteps; ++i)
        for (int k = 0; k < kSteps; ++k) {
            const double square = (i + 0.5) / kSteps, angle = 2 * kPi * (k + 0.5) / kSteps,
                         slope = std::sqrt(square / (1 - square));
            const glm::dvec3 hit(slope * std::cos(angle), 1, slope * std::sin(angle));
            if (std::abs(hit.x) < 9 && std::abs(hit.z) < 9) // the sky past them has a mean x of 0
                expected += glm::normalize(hit - glm::dvec3(probe)).x;
        }
    expected *= kPi / kSteps / kSteps * std::sqrt(3 / (4 * kPi));
    EXPECT_LT(expected, -0.2);
    EXPECT_NEAR(halfToFloat(t.coefficients[3]), expected, 0.01) << "l = 1, m = 1";
}

TEST(RelightRays, ConstantRadianceHasNoHigherBands) {
    for (const std::uint32_t rays : {100U, 800U, 4000U}) {
        SparseBake bake;
        bake.sparse.rays = rays;
        bake.probes = {glm::vec3(0)};
        bake.hits.assign(rays, 0);
        bake.receivers.texel = {0};
        const std::vector<float> basis =
            relightBasis(relightDirections(rays), int(bake.sparse.bands));
        ProbeRadiance sky(48, 0), probes;
        gatherProbes(bake, basis, std::vector{glm::vec3(1, 2, 3)}, sky, probes);
        for (std::size_t c = 0; c < 3; ++c) {
            const float* p = &probes[c * 16];
            EXPECT_NEAR(p[0], double(c + 1) * std::sqrt(4 * kPi), 1e-4 * p[0]);
            for (int i = 1; i < 16; ++i)
                EXPECT_LT(std::abs(p[i] / p[0]), 2 / std::sqrt(double(rays))) << i;
        }
    }
}

/// A lit room and a dark one, each 2 m wide, with a wall without thickness between them. The
/// receiver lies on the floor of the dark one, next to the wall. Returns the share of the lit
/// room's radiance that it receives, as irradiance over pi.
float leakOf(bool visibility) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box({-2, 0, 0}, {0, 2, 2}, true));
    b.add(simple::box({0.01f, 0, 0}, {2, 2, 2}, true));
    b.add(simple::quad({0.1f, 1e-4f, 1.1f}, {0.2f, 0, 0}, {0, 0, -0.2f}));
    const Scene scene = b.build();
    const TraceScene trace(scene);
    const std::vector<glm::vec3> lit = {{-0.3f, 0.5f, 1}}, probes = {lit[0], {0.6f, 0.5f, 1}};
    const Transport t = traceTransport(trace, std::vector{texelOf(2, {0, 0.5f})}, probes,
                                       {.rays = 1024, .visibility = visibility});
    // The lit probe sees radiance 1 all around, the other one none.
    double e = 0;
    for (std::size_t k = 0; k < 2; ++k)
        if (t.probe[k] == 0)
            e += double(halfToFloat(t.coefficients[k * 16])) * std::sqrt(4 * kPi);
    return float(e / kPi);
}

TEST(Transport, WhatProbesSeeKeepsLightFromPassingAThinWall) {
    const float checked = leakOf(true), simple = leakOf(false);
    std::printf("leak through a thin wall: %.4f by visibility, %.4f by simple weights\n",
                double(checked), double(simple));
    EXPECT_LT(checked, 0.01);
    EXPECT_GT(simple, 0.2);
}

TEST(Transport, WhatNoProbeSeesIsCountedAndBlackUnlessAskedFor) {
    // The only probe is in another room.
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box({-2, 0, 0}, {0, 2, 2}, true));
    b.add(simple::box({0.01f, 0, 0}, {2, 2, 2}, true));
    b.add(simple::quad({0.1f, 1e-4f, 1.1f}, {0.2f, 0, 0}, {0, 0, -0.2f}));
    const TraceScene trace(b.build());
    const std::vector<glm::vec3> probe = {{-1, 1, 1}};
    const std::vector<AtlasTexel> texels = {texelOf(2, {0, 0.5f})};
    const Transport dark = traceTransport(trace, texels, probe, {});
    EXPECT_EQ(dark.unseen[0], 1);
    EXPECT_EQ(halfToFloat(dark.coefficients[0]), 0);
    const Transport anyway = traceTransport(trace, texels, probe, {.unchecked = true});
    EXPECT_EQ(anyway.unseen[0], 1);
    EXPECT_NEAR(halfToFloat(anyway.coefficients[0]), kPi / std::sqrt(4 * kPi), 2e-3);
}

} // namespace
} // namespace limn::transport_test
