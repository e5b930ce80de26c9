// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "tests/techniques/illuminance/relight/lit_room.h"

#include <gtest/gtest.h>

#include <cmath>

namespace limn::strong_light_test {
namespace {

// Every kind of light at once, as strong as may be, with lamps less than a micrometre above a point
// of a surfel.
TEST(StrongLight, StaysWithinFloat) {
    Scene scene = *litRoom(300, 300);
    const TraceScene trace{scene};
    const auto made = std::make_shared<const Bake>(*bake(trace));
    Light strong{.color = glm::vec3(kMaxLight), .strength = kMaxLight};
    strong.position = made->surfels.lightPoints[0] + 8e-7f * made->surfels.lightNormals[0];
    scene.lights.assign(50, strong);
    for (const LightKind kind : {LightKind::Directional, LightKind::Spot, LightKind::Rectangle}) {
        scene.lights.push_back(strong);
        scene.lights.back().kind = kind;
        scene.lights.back().position = {2, 2.5f, 2};
    }
    scene.sky.radiance = glm::vec3(kMaxLight);
    for (Material& m : scene.materials) {
        m.baseColor = glm::vec4(1);
        m.emission = glm::vec3(kMaxLight);
    }
    Relighter relighter(made, LitBands::All);
    relighter.relight(scene, trace, 64);
    float largest = 0;
    for (const std::vector<glm::vec4>* of :
         {&relighter.field().lightmap, &relighter.radiosity(), &relighter.field().grid})
        for (const glm::vec4 v : *of) {
            ASSERT_TRUE(std::isfinite(v.x + v.y + v.z));
            largest = std::max(largest, v.x);
        }
    EXPECT_GT(largest, 1e29f); // of the lamps
}

} // namespace
} // namespace limn::strong_light_test
