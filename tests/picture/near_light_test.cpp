// SPDX-License-Identifier: MIT
#include "engine/picture/near_light.h"

#include "engine/lightmap/near_reach.h"
#include "engine/picture/field_render.h"
#include "engine/reference/reference.h"
#include "tests/picture/two_plates.h"

#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

namespace limn::near_light_test {
namespace {

constexpr float kPi = glm::pi<float>();

/// Mean correction of the irradiance that arrives at a point of the plane.
glm::vec3 correctionAt(const TwoPlates& plates, const Scene& scene, glm::vec3 point,
                       std::uint32_t rays = 16384) {
    const TraceScene trace(scene);
    const NearLight near = nearLight(trace, plates.field, *plates.layout, rays);
    const Hit hit =
        trace.closestHit({point + glm::vec3(0, 0.01f, 0), glm::vec3(0, -1, 0), 0, 0.02f});
    EXPECT_EQ(hit.instance, 0U);
    return nearCorrection(near, hit, *surfacePoint(trace, hit), {1, 0});
}

TEST(NearReach, IsHalfTheWidthOfATexel) {
    TwoPlates plates(plateAbove(1));
    const std::vector<float> reach = nearReaches(plates.builder.build(), *plates.layout);
    EXPECT_NEAR(reach[0], TwoPlates::kReach, 1e-5f);
    EXPECT_NEAR(reach[1], TwoPlates::kReach, 1e-5f);
}

TEST(NearReach, IsZeroWithoutALightmapAndBoundedWhereChartsCoverNoTexel) {
    TwoPlates plates(plateAbove(1));
    plates.layout->instances[1].uv.clear();
    const Scene scene = plates.builder.build();
    EXPECT_EQ(nearReaches(scene, *plates.layout)[1], 0);
    plates.layout->instances[1].uv.assign(4, {4.5f / 8, 0.5f / 4});
    const std::vector<float> reach = nearReaches(scene, *plates.layout);
    // The scene's texels are twice as large as the plane's, as the plate has none.
    EXPECT_NEAR(reach[1], TwoPlates::kReach * std::sqrt(2.f), 1e-5f);
    EXPECT_EQ(nearReaches(scene, {}), std::vector<float>(2, 0));
}

TEST(NearReach, IsAFourthWhereTexelsAreFiner) {
    TwoPlates plates(plateAbove(1));
    plates.refineMiddle();
    const float reach = nearReaches(plates.builder.build(), *plates.layout)[0];
    const auto reachAt = [&](float u, float v) {
        return nearReachAt(*plates.layout, reach, 0, 0, 0, u, v, false);
    };
    EXPECT_NEAR(reachAt(0.2f, 0.4f), TwoPlates::kReach / 4, 1e-5f); // 0.4 m left of the middle
    EXPECT_NEAR(reachAt(0.1f, 0.1f), TwoPlates::kReach, 1e-5f);
}

TEST(NearReach, WeightsFadeToTheEnd) {
    EXPECT_EQ(nearWeight(0, 2), 1);
    EXPECT_EQ(nearWeight(1, 2), 1);
    EXPECT_FLOAT_EQ(nearWeight(1.5f, 2), 0.5f);
    EXPECT_EQ(nearWeight(2, 2), 0);
    EXPECT_EQ(nearWeight(3, 2), 0);
}

// At height reach / 4 the plate is met after t = reach / (4 z) in direction z = cos, with weight
// min(2 - 1 / (2 z), 1) for z > 1/4. Its radiance L is to bring
//   2 pi L (int_{1/2}^1 z dz + int_{1/4}^{1/2} (2 z - 1/2) dz) = 7/8 pi L.
TEST(NearLight, APlateCloseAboveSendsItsOwnLight) {
    TwoPlates plates(plateAbove(TwoPlates::kReach / 4));
    const glm::vec3 radiance(1, 2, 4);
    plates.setField(1, {0, -1, 0}, radiance / 0.5f); // reflected by half
    const glm::vec3 E = correctionAt(plates, plates.builder.build(), {0.3f, 0, -0.2f});
    EXPECT_LT(glm::length(E - 7.f / 8 * kPi * radiance), 0.005f * glm::length(E));
}

TEST(NearLight, WhatTheFieldSaidArrivesFromThereGoes) {
    TwoPlates plates(plateAbove(TwoPlates::kReach / 4));
    const glm::vec3 radiance(1, 2, 4);
    plates.setField(0, {0, 1, 0}, radiance);
    const glm::vec3 E = correctionAt(plates, plates.builder.build(), {0.3f, 0, -0.2f});
    EXPECT_LT(glm::length(E + 7.f / 8 * kPi * radiance), 0.005f * glm::length(E));
}

TEST(NearLight, ReachesLessWhereTexelsAreFiner) {
    TwoPlates plates(plateAbove(TwoPlates::kReach / 2));
    plates.refineMiddle();
    plates.setField(0, {0, 1, 0}, glm::vec3(1));
    EXPECT_EQ(correctionAt(plates, plates.builder.build(), {0.3f, 0, -0.2f}, 64), glm::vec3(0));
    EXPECT_LT(correctionAt(plates, plates.builder.build(), {0.3f, 0, -0.8f}, 64).x, -0.5f);
}

// In a furnace each surface sends what the field says arrives from everywhere.
TEST(NearLight, AFurnaceStaysAsItIs) {
    for (const Mesh& plate : {plateAbove(0.1f), plateAbove(0.5f), wall()}) {
        TwoPlates plates(plate, 1);
        plates.builder.scene.materials[1].baseColor = glm::vec4(0.8f);
        plates.setField(0, {0, 1, 0}, glm::vec3(0.8f)); // as bright as the plate
        plates.setField(1, plate.normals[0], glm::vec3(1));
        for (const float z : {0.02f, 0.2f, 0.5f}) {
            const glm::vec3 E = correctionAt(plates, plates.builder.build(), {0.1f, 0, z}, 256);
            EXPECT_LT(glm::length(E), 1e-4f);
        }
    }
}

TEST(NearLight, NothingChangesWhereNothingIsNearOrItIsEmissiveOrDynamicOrNoRayLooks) {
    const float height = TwoPlates::kReach / 4;
    const auto correction = [](TwoPlates& plates, std::uint32_t rays = 64) {
        plates.setField(0, {0, 1, 0}, glm::vec3(1));
        return correctionAt(plates, plates.builder.build(), {0, 0, 0}, rays);
    };
    TwoPlates far(plateAbove(1.01f * TwoPlates::kReach)), emissive(plateAbove(height)),
        dynamic(plateAbove(height)), close(plateAbove(height));
    emissive.builder.scene.materials[1].emission = glm::vec3(1e4f);
    dynamic.builder.scene.instances[1].dynamic = true;
    EXPECT_EQ(correction(far), glm::vec3(0));
    EXPECT_EQ(correction(emissive), glm::vec3(0));
    EXPECT_EQ(correction(dynamic), glm::vec3(0));
    EXPECT_EQ(correction(close, 0), glm::vec3(0));
    EXPECT_LT(correction(close).x, -1);
}

// A sun lights a floor before a wall, from where the wall's shadow ends. The field is dark, so that
// the wall's foot has that part of the path tracer's light which comes from within reach.
TEST(NearLight, ASunlitFloorWithinReachLightsAWall) {
    TwoPlates plates(wall(), 0.8f);
    Light sun;
    sun.kind = LightKind::Directional;
    sun.direction = glm::normalize(glm::vec3(0, -1, 0.05f)); // the wall shades 0.2 m of the floor
    sun.strength = 3;
    plates.builder.scene.lights = {sun};
    const TraceScene trace(plates.builder.build());
    FieldRenderOptions options;
    options.view = View::Irradiance;
    options.camera = {.eye = {0, 0.15f, 1.5f}, .target = {0, 0.15f, 0}, .fovY = 0.2f};
    options.width = options.height = 8;
    options.samplesPerPixel = 256;
    options.nearRays = 4;
    const ImageF near = renderField(trace, plates.field, *plates.layout, options);
    ReferenceOptions truth;
    truth.view = options.view;
    truth.camera = options.camera;
    truth.width = truth.height = 8;
    truth.samplesPerPixel = 1024;
    const ImageF reference = renderReference(trace, truth).image;
    double sum = 0, sumTruth = 0;
    for (std::size_t i = 0; i < near.rgb.size(); ++i) {
        sum += double(near.rgb[i].y);
        sumTruth += double(reference.rgb[i].y);
    }
    // What is sunlit beyond the reach, from 2/3 m on, is for the field, which is dark here.
    EXPECT_GT(sum, 0.3 * sumTruth);
    EXPECT_LT(sum, 0.95 * sumTruth);
}

} // namespace
} // namespace limn::near_light_test
