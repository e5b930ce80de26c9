// SPDX-License-Identifier: MIT
#include "engine/picture/emitted_light.h"

#include "engine/reference/path.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn::emitted_light_test {
namespace {

using namespace simple;

constexpr double kPi = glm::pi<double>();

SurfacePoint pointOnFloor() {
    return {.geometricNormal = {0, 1, 0}, .normal = {0, 1, 0}, .albedo = glm::vec3(0.5f)};
}

glm::dvec3 meanAt(const TraceScene& trace, const SurfacePoint& p, std::uint32_t samples,
                  const LightGuide* guide = nullptr) {
    const EmittedLightSources sources = findEmittedLightSources(trace);
    glm::dvec3 sum(0);
    for (std::uint32_t k = 0; k < samples; ++k)
        for (const IncidentLightSample& f :
             sampleEmittedLight(trace, sources, p, {5, k}, guide).samples)
            sum += glm::dvec3(f.irradiance);
    return sum / double(samples);
}

/// A guide that has seen all of its light in one direction.
LightGuide guideTo(glm::vec3 direction) {
    LightGuide guide;
    guide.add(glm::normalize(direction), 1);
    guide.finish(0.75f);
    return guide;
}

/// A closed box with a square hole of 1 m, 2 m above the origin, under an even sky.
Scene belowAHole() {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0)));
    Mesh room = box({-5, -1, -5}, {5, 2, 5}, true);
    room.indices.erase(room.indices.begin() + 18, room.indices.begin() + 24); // its roof
    b.add(room);
    b.add(quad({-5, 2, -5}, {4.5f, 0, 0}, {0, 0, 10}));
    b.add(quad({0.5f, 2, -5}, {4.5f, 0, 0}, {0, 0, 10}));
    b.add(quad({-0.5f, 2, -5}, {1, 0, 0}, {0, 0, 4.5f}));
    b.add(quad({-0.5f, 2, 0.5f}, {1, 0, 0}, {0, 0, 4.5f}));
    b.scene.sky.radiance = {1, 2, 3};
    return b.build();
}

/// Form factor of a point to a parallel square of half width a, above its middle at height h.
double formFactor(double a, double h) {
    const double r = std::sqrt(a * a + h * h);
    return 4 * a / (kPi * r) * std::atan(a / r);
}

TEST(EmittedLight, OfTheSkyThroughAHoleIsItsFormFactor) {
    const TraceScene trace(belowAHole());
    const double expected = kPi * formFactor(0.5, 2);
    const LightGuide up = guideTo({0.01f, 1, 0.01f}), aside = guideTo({1, 0.3f, 0});
    for (const LightGuide* guide : {static_cast<const LightGuide*>(nullptr), &up, &aside}) {
        const glm::dvec3 E = meanAt(trace, pointOnFloor(), 1 << 20, guide);
        EXPECT_NEAR(E.x, expected, 0.01 * expected); // three standard errors
        EXPECT_NEAR(E.z, 3 * E.x, 1e-3);
    }
}

TEST(EmittedLight, AGuideToTheHoleSavesNoise) {
    const TraceScene trace(belowAHole());
    const EmittedLightSources sources = findEmittedLightSources(trace);
    LightGuide learned;
    const auto squares = [&](const LightGuide* guide, LightGuide* learns) {
        double sum = 0;
        for (std::uint32_t k = 0; k < 4096; ++k) {
            double value = 0;
            for (const IncidentLightSample& f :
                 sampleEmittedLight(trace, sources, pointOnFloor(), {9, k}, guide).samples) {
                value += double(f.irradiance.x);
                if (learns && f.irradiance.x > 0)
                    learns->add(f.toLight, f.irradiance.x);
            }
            sum += value * value;
        }
        return sum;
    };
    const double before = squares(nullptr, &learned);
    learned.finish(0.75f);
    // Three of four rays are guided to the cells around the zenith, of which the hole fills .3. Of
    // the others, which follow the cosine, .07 pass the hole.
    EXPECT_LT(squares(&learned, nullptr), 0.35 * before);
}

TEST(EmittedLight, OfAPanelIsItsFormFactorHoweverItIsFound) {
    for (const float half : {0.05f, 0.5f, 5.f}) {
        SceneBuilder b;
        b.addMaterial(lambert(glm::vec3(0), {4, 5, 6}));
        b.add(quad({-half, 1, -half}, {2 * half, 0, 0}, {0, 0, 2 * half})); // faces down
        const TraceScene trace(b.build());
        const glm::dvec3 E = meanAt(trace, pointOnFloor(), 1 << 14);
        const double expected = kPi * formFactor(double(half), 1);
        EXPECT_NEAR(E.x, 4 * expected, 0.02 * expected) << half;
        EXPECT_NEAR(E.z, 6 * expected, 0.03 * expected) << half;
        const EmittedLightSample one =
            sampleEmittedLight(trace, findEmittedLightSources(trace), pointOnFloor(), {5, 0});
        EXPECT_EQ(one.samples[0].instance, 0U);
    }
}

TEST(EmittedLight, IsThatOfPathsWhereNothingReflects) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0)));
    b.addMaterial(lambert(glm::vec3(0), {3, 1, 2}));
    b.add(box({-1, 0.2f, -1}, {0, 1, 0}, false));
    b.add(box({0.5f, 0.5f, 0.2f}, {0.8f, 0.9f, 0.9f}, false, 1));
    ImageF image{8, 4, std::vector<glm::vec3>(32, glm::vec3(0.2f))};
    image.rgb[11] = {40, 30, 20};
    b.scene.sky.kind = SkyKind::Image;
    b.scene.sky.panorama = makeSkyImage(std::move(image));
    const TraceScene trace(b.build());
    const EmittedLightSources sources = findEmittedLightSources(trace);
    const PathContext context{trace, sources.emitters, sources.sky};
    constexpr std::uint32_t kSamples = 1 << 16;
    glm::dvec3 paths(0);
    std::uint64_t rays = 0;
    for (std::uint32_t k = 0; k < kSamples; ++k)
        paths += glm::dvec3(sampleIndirectIrradiance(context, pointOnFloor(), {2, k}, rays));
    const LightGuide guide = guideTo({-1, 1, 1});
    for (const LightGuide* used : {static_cast<const LightGuide*>(nullptr), &guide}) {
        const glm::dvec3 E = meanAt(trace, pointOnFloor(), kSamples, used);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(E[k], paths[k] / kSamples, 0.01 * E[k]);
    }
}

TEST(EmittedLightSources, AreFoundWhereTheSkyOrASurfaceEmits) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
    b.scene.lights.resize(1);
    EXPECT_FALSE(findEmittedLightSources(TraceScene(b.build())).any);
    b.scene.sky.radiance = {0, 0, 1e-3f};
    EXPECT_TRUE(findEmittedLightSources(TraceScene(b.build())).any);
    b.scene.sky = {};
    b.scene.materials[0].emission = {0, 1, 0};
    EXPECT_TRUE(findEmittedLightSources(TraceScene(b.build())).any);
}

} // namespace
} // namespace limn::emitted_light_test
