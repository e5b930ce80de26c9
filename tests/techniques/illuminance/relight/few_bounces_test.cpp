// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/relight/bouncing.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace limn::few_bounces_test {
namespace {

using namespace simple;

struct FewBounces : testing::Test {
    Scene scene = room();
    TraceScene trace{scene};
    std::shared_ptr<const Bake> made = std::make_shared<const Bake>(*bake(trace));
    Relighter relighter{made};

    static Scene room() {
        SceneBuilder b;
        b.addMaterial(lambert({0.8f, 0.5f, 0.3f}));
        b.add(box(glm::vec3(0), glm::vec3(4, 3, 5), true));
        b.scene.lights.resize(1);
        b.scene.lights[0].position = {2, 2.5f, 2};
        b.scene.lights[0].strength = 5;
        b.scene.bake.surfels = 500;
        b.scene.bake.lightmapCaches = 500;
        b.scene.bake.rays = 64;
        b.scene.bake.links = 32;
        return b.build();
    }
    /// All that the scene asks for.
    std::vector<glm::vec4> light(Relighter& by) const {
        by.relight(scene, trace, scene.relight.maxBounces);
        return by.field().lightmap;
    }
    std::vector<glm::vec4> lightAnew() const {
        Relighter fresh(made);
        return light(fresh);
    }
};

TEST_F(FewBounces, LeaveNothingOfTheLightThatWas) {
    for (const std::uint32_t bounces : {1U, 2U, kFewBounces}) {
        scene.relight.maxBounces = bounces;
        for (const float x : {1.f, 3.f}) {
            scene.lights[0].position.x = x;
            EXPECT_EQ(light(relighter), lightAnew()) << bounces << " bounces";
        }
        scene.materials[0].baseColor = {0.3f, 0.4f, 0.5f, 1};
        EXPECT_EQ(light(relighter), lightAnew()) << bounces << " bounces";
        scene.sky.radiance += glm::vec3(1);
        EXPECT_EQ(light(relighter), lightAnew()) << bounces << " bounces";
        scene.materials[0].baseColor = {0.8f, 0.5f, 0.3f, 1};
    }
}

TEST_F(FewBounces, FollowTheirNumberWhileTheLightStandsStill) {
    const std::vector<glm::vec4> all = light(relighter);
    scene.relight.maxBounces = 1;
    const std::vector<glm::vec4> one = light(relighter);
    EXPECT_EQ(one, lightAnew());
    scene.relight.maxBounces = 64;
    const std::vector<glm::vec4> again = light(relighter);
    float difference = 0, largest = 0, gain = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        largest = std::max(largest, all[i].x);
        difference = std::max(difference, std::abs(all[i].x - again[i].x));
        gain = std::max(gain, all[i].x - one[i].x);
    }
    EXPECT_LT(difference, 1e-3f * largest); // both stop where a bounce adds 1e-4
    EXPECT_GT(gain, 0.2f * largest);
}

// In a grey closed room every bounce passes on the same share, the albedo.
TEST_F(FewBounces, ToleranceDecidesHowManyOfManyThereAre) {
    scene.materials[0].baseColor = {0.5f, 0.5f, 0.5f, 1};
    const std::uint32_t most = scene.relight.maxBounces;
    scene.relight.tolerance = 0.001f;
    const RelightStats exact = relighter.relight(scene, trace, most);
    const std::vector<glm::vec4> sent = relighter.radiosity();
    std::uint32_t bounces = exact.bounces;
    for (const float tolerance : {0.1f, 1.f, 10.f}) {
        scene.relight.tolerance = tolerance;
        Relighter coarse(made);
        const RelightStats stats = coarse.relight(scene, trace, most);
        EXPECT_TRUE(stats.converged);
        EXPECT_LT(stats.bounces, bounces) << tolerance;
        bounces = stats.bounces;
        double missing = 0, all = 0;
        for (std::size_t i = 0; i < made->surfels.size(); ++i) {
            const auto area = double(made->surfels.area[i]);
            missing += area * double(sent[i].x - coarse.radiosity()[i].x);
            all += area * double(sent[i].x);
        }
        EXPECT_LT(missing / all, double(tolerance) / 100);
        EXPECT_GT(missing, 0);
    }
    EXPECT_TRUE(relighter.relight(scene, trace, most).converged) << "more tolerance asks for less";
    scene.relight.tolerance = 0.001f;
    EXPECT_FALSE(relighter.relight(scene, trace, most).skipped) << "a change of its own";
}

} // namespace
} // namespace limn::few_bounces_test
