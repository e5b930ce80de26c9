// SPDX-License-Identifier: MIT
#include "engine/scene/mesh/input_hash.h"
#include "engine/techniques/illuminance/bake/rays/seen_hits.h"
#include "engine/techniques/illuminance/bake/rays/trace_stage.h"
#include "tests/shading/light_formulas.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>

#include <glm/geometric.hpp>

namespace limn::aimed_samples_test {
namespace {

using namespace simple;

constexpr std::uint32_t kAcross = 48; ///< caches along either side of the floor

/// A square lamp that faces down, of which only x < 0 may be in sight.
struct Lamp {
    float width;  ///< [m]; from -width / 2 along x and z
    float height; ///< above the floor [m]
    bool covered; ///< by a plate closely below the half x > 0

    Scene scene() const {
        SceneBuilder b;
        b.addMaterial(lambert(glm::vec3(0.5f)));
        b.addMaterial(lambert(glm::vec3(0), glm::vec3(1)));
        b.add(quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}));
        b.add(quad({-width / 2, height, -width / 2}, {width, 0, 0}, {0, 0, width}, 1));
        if (covered)
            b.add(quad({0, height * 0.9999f, -4}, {4, 0, 0}, {0, 0, 8}));
        return b.build();
    }

    /// Irradiance at `p` on the floor, for a radiosity of 1.
    double irradianceAt(glm::vec3 p) const {
        const double w = double(width) / 2, right = covered ? 0 : w;
        std::array<glm::dvec3, 4> corner = {
            glm::dvec3(-w, height, -w), glm::dvec3(right, height, -w), glm::dvec3(right, height, w),
            glm::dvec3(-w, height, w)};
        for (glm::dvec3& c : corner)
            c -= glm::dvec3(p);
        return formulas::polygonIrradiance(corner, {0, 1, 0}) / formulas::kPi;
    }
};

/// Caches on a square of the floor, `width` wide.
void placeOnFloor(float width, Caches& caches, CachePoints& points) {
    points.begin = {0};
    for (std::uint32_t i = 0; i < kAcross * kAcross; ++i) {
        const glm::vec2 in = (glm::vec2(i % kAcross, i / kAcross) + 0.5f) / float(kAcross) - 0.5f;
        points.position.emplace_back(width * in.x, 0, width * in.y);
        points.normal.emplace_back(0, 1, 0);
        points.seed.push_back(i);
        points.begin.push_back(i + 1);
        caches.kind.push_back(CacheKind::Hemisphere);
        caches.position.push_back(points.position.back());
        caches.normal.push_back(points.normal.back());
    }
    caches.lightmapCount = kAcross * kAcross;
}

/// Irradiance that caches get from rays aimed at the lamp's surfels, which all lie at `place`, over
/// the closed form.
double aimedShare(const Lamp& lamp, std::uint32_t surfels, glm::vec3 place) {
    const Scene scene = lamp.scene();
    const TraceScene trace(scene);
    SurfelSet set = placeSurfels(scene, surfels);
    for (std::uint32_t s = set.instanceBegin[1]; s < set.instanceBegin[2]; ++s)
        set.surfels.position[s] = place;
    const OwnerTables owners(scene, set);
    set.surfels.area = ownedAreas(scene, set, owners);
    Caches caches;
    CachePoints points;
    placeOnFloor(1, caches, points);
    GatherHits hits;
    EXPECT_TRUE(
        traceHits({trace, set, owners, caches, points, Linker::Gather, 256, hashMeshes(scene)}, {},
                  nullptr, hits));
    double sum = 0, truth = 0;
    for (std::uint32_t c = 0; c < caches.size(); ++c) {
        forEachAimedSample(set.surfels, hits, points, caches, c,
                           [&](std::uint32_t, const FormFactor& formFactor, float) {
                               sum += double(formFactor.irradiance);
                           });
        truth += lamp.irradianceAt(points.position[c]);
    }
    return sum / truth;
}

// Irradiance from the whole patch would be twice as strong, since its place is in sight.
TEST(AimedSamples, OfAPatchHalfBehindAPlateBringTheLightOfTheOtherHalf) {
    const Lamp lamp{.width = 0.4f, .height = 2, .covered = true};
    EXPECT_NEAR(aimedShare(lamp, 2, {-0.1f, 2, 0}), 1, 0.04);
}

TEST(AimedSamples, OfAPatchWhosePlaceIsHiddenBringTheLightOfTheOtherHalf) {
    const Lamp lamp{.width = 0.4f, .height = 2, .covered = true};
    EXPECT_NEAR(aimedShare(lamp, 2, {0.1f, 2, 0}), 1, 0.04);
}

// From a little beyond four times the extent of about 0.43 m. There, a / 2 pi in the denominator of
// the solid angle would take 4 % of it.
TEST(AimedSamples, BringTheLightOfALampThatIsAsNearAsMayBe) {
    const Lamp lamp{.width = 1, .height = 1.9f, .covered = false};
    EXPECT_NEAR(aimedShare(lamp, 2, {0, 1.9f, 0}), 1, 0.01);
}

TEST(AimedSamples, OfManyPatchesBringTheLightOfAWholeLamp) {
    const Lamp lamp{.width = 0.4f, .height = 2, .covered = false};
    const Scene scene = lamp.scene();
    const SurfelSet set = placeSurfels(scene, 40000);
    ASSERT_GT(set.instanceBegin[2] - set.instanceBegin[1], 80U);
    EXPECT_NEAR(aimedShare(lamp, 40000, {0, 2, 0}), 1, 0.01);
}

} // namespace
} // namespace limn::aimed_samples_test
