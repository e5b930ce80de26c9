// SPDX-License-Identifier: MIT
#include "engine/rsm/rsm_inputs.h"

#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <string>

namespace limn::rsm_inputs_test {
namespace {

Scene roomUnder(const Sky& sky, bool emitter) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.scene.materials[1].emission = glm::vec3(emitter ? 1 : 0);
    b.add(simple::quad(glm::vec3(0), {0, 0, 1}, {1, 0, 0}));
    b.add(simple::quad({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 1));
    b.scene.sky = sky;
    return b.build();
}

std::string leftOut(const Scene& scene, const OtherSources& taken = {}) {
    const char* clause = sourcesLeftOut(scene, taken);
    return clause ? clause : "";
}

TEST(RsmInputs, SayWhichSourcesOfLightATechniqueLeavesOut) {
    const Sky none;
    Sky plain, gradient, image;
    plain.radiance = {0, 0, 1};
    gradient.kind = SkyKind::Gradient;
    gradient.ground = {1, 0, 0};
    image.kind = SkyKind::Image;
    EXPECT_EQ(leftOut(roomUnder(none, false)), "");
    for (const Sky& sky : {plain, gradient, image}) {
        const std::string alone = leftOut(roomUnder(sky, false)),
                          both = leftOut(roomUnder(sky, true));
        EXPECT_TRUE(alone.ends_with("the light of the sky")) << alone;
        EXPECT_TRUE(both.ends_with("the light of the sky and of emissive surfaces")) << both;
        EXPECT_EQ(leftOut(roomUnder(sky, true), {.emitters = true}), alone);
        EXPECT_EQ(leftOut(roomUnder(sky, true), {.emitters = true, .sky = true}), "");
    }
    const std::string emitters = leftOut(roomUnder(none, true));
    EXPECT_TRUE(emitters.ends_with("the light of emissive surfaces")) << emitters;
    image.strength = 0;
    EXPECT_EQ(leftOut(roomUnder(image, false)), "");
    Scene unused = roomUnder(none, true);
    unused.instances.pop_back();
    EXPECT_EQ(leftOut(unused), "") << "no surface has the material that emits";
}

} // namespace
} // namespace limn::rsm_inputs_test
