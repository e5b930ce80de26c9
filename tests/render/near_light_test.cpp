// SPDX-License-Identifier: MIT
// Light from near surfaces on the device against that on the CPU, which tests/measure checks.
#include "engine/picture/field_render.h"
#include "tests/picture/two_plates.h"
#include "tests/render/viewport_fixture.h"

#include <glm/gtc/matrix_transform.hpp>

namespace limn::near_light_device_test {
namespace {

constexpr std::uint32_t kSamples = 64;

class ViewportNearLight : public ViewportTest {
protected:
    void SetUp() override {
        ViewportTest::SetUp();
        options.camera = {.eye = {0.5f, 1.2f, 2}, .target = {0, 0.1f, 0}, .fovY = 0.5f};
        options.width = options.height = 24;
        options.view = View::Irradiance;
    }

    ImageF onDevice(const TwoPlates& plates, const Scene& scene, std::uint32_t nearRays) {
        options.nearRays = nearRays;
        viewport->setIndirect(plates.field);
        viewport->setScene(scene, plates.layout);
        viewport->render(options);
        for (std::uint32_t s = 1; s < kSamples; ++s)
            viewport->refine();
        return viewport->readLinear();
    }

    ImageF onCpu(const TwoPlates& plates, const Scene& scene, std::uint32_t nearRays) const {
        FieldRenderOptions o;
        o.view = options.view;
        o.camera = options.camera;
        o.width = options.width;
        o.height = options.height;
        o.samplesPerPixel = kSamples;
        o.nearRays = nearRays;
        return renderField(TraceScene(scene), plates.field, *plates.layout, o);
    }

    /// The pictures differ by less than `relative` of their mean, as rms and as a mean.
    static void expectAlike(const ImageF& a, const ImageF& b, double relative) {
        double sum = 0, difference = 0, squares = 0;
        for (std::size_t i = 0; i < a.rgb.size(); ++i) {
            const glm::vec3 d = a.rgb[i] - b.rgb[i];
            sum += double(b.rgb[i].x + b.rgb[i].y + b.rgb[i].z);
            difference += double(d.x + d.y + d.z);
            squares += double(glm::dot(d, d));
        }
        const auto n = 3 * double(a.rgb.size());
        EXPECT_LT(std::sqrt(squares / n), relative * sum / n);
        EXPECT_LT(std::abs(difference), 0.2 * relative * sum);
    }
};

Light sun() {
    Light light;
    light.kind = LightKind::Directional;
    light.direction = glm::normalize(glm::vec3(0.1f, -1, -0.3f));
    light.strength = 3;
    return light;
}

TEST_F(ViewportNearLight, IsThatOfTheCpu) {
    TwoPlates plates(wall(), 0.6f);
    plates.builder.scene.materials[1].baseColor = {0.9f, 0.5f, 0.2f, 1};
    Light lamp;
    lamp.position = {0.5f, 0.5f, 0.8f};
    lamp.strength = 0.3f;
    plates.builder.scene.lights = {sun(), lamp};
    plates.setField(0, {0, 1, 0}, {0.3f, 0.2f, 0.1f});
    plates.setField(1, {0, 0, 1}, {0.1f, 0.2f, 0.3f});
    const Scene scene = plates.builder.build();
    const ImageF without = onCpu(plates, scene, 0), with = onCpu(plates, scene, 8);
    double changed = 0, sum = 0;
    for (std::size_t i = 0; i < with.rgb.size(); ++i) {
        changed += double(with.rgb[i].x - without.rgb[i].x);
        sum += double(without.rgb[i].x);
    }
    EXPECT_GT(changed, 0.03 * sum) << "near light is to matter here";
    expectAlike(onDevice(plates, scene, 8), with, 0.03);
    expectAlike(onDevice(plates, scene, 0), without, 0.01);
}

TEST_F(ViewportNearLight, ReachesLessWhereTexelsAreFiner) {
    TwoPlates plates(wall(), 0.6f);
    plates.builder.scene.lights = {sun()};
    const Scene scene = plates.builder.build();
    plates.setField(1, {0, 0, 1}, glm::vec3(0.5f));
    const ImageF coarse = onCpu(plates, scene, 8);
    plates.refineMiddle();
    plates.setField(1, {0, 0, 1}, glm::vec3(0.5f));
    const ImageF fine = onCpu(plates, scene, 8);
    double changed = 0, sum = 0;
    for (std::size_t i = 0; i < fine.rgb.size(); ++i) {
        changed += double(std::abs(fine.rgb[i].x - coarse.rgb[i].x));
        sum += double(coarse.rgb[i].x);
    }
    EXPECT_GT(changed, 0.05 * sum) << "finer texels are to matter here";
    expectAlike(onDevice(plates, scene, 8), fine, 0.03);
}

// The wall shades the floor before it, so that nothing near is lit. Shadow maps are as coarse as
// those of a house on a wide ground.
TEST_F(ViewportNearLight, IsDarkAtTheFootOfAWallThatTheSunIsBehind) {
    TwoPlates plates(wall(), 0.8f);
    plates.builder.add(simple::quad({-300, -1, 300}, {600, 0, 0}, {0, 0, -600}));
    plates.layout->instances.emplace_back();
    plates.layout->meshes.emplace_back();
    Light light = sun();
    light.direction = glm::normalize(glm::vec3(0.3f, -1, 0.5f));
    plates.builder.scene.lights = {light};
    const Scene scene = plates.builder.build();
    viewport->setCoarseShadows(true);
    const ImageF picture = onDevice(plates, scene, 8);
    double sum = 0;
    for (const glm::vec3& E : picture.rgb)
        sum += double(E.x);
    // With shadow maps alone this mean is 0.027.
    EXPECT_LT(sum / double(picture.rgb.size()), 1e-5);
}

TEST_F(ViewportNearLight, IsFoundOnBacksAndMirroredInstances) {
    for (const bool twoSided : {false, true}) {
        TwoPlates plates(simple::quad({-2, 0, 0}, {0, 4, 0}, {4, 0, 0}, 1)); // faces away
        plates.builder.scene.materials[1].doubleSided = twoSided;
        if (twoSided)
            plates.addBack();
        plates.builder.scene.instances[0].toWorld = glm::scale(glm::mat4(1), glm::vec3(-1, 1, 1));
        plates.builder.scene.instances[0].normalToWorld =
            glm::mat3(glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, -1)) * -1.f;
        plates.builder.scene.lights = {sun()};
        plates.setField(0, {0, 1, 0}, glm::vec3(0.2f));
        plates.setField(1, {0, 0, -1}, glm::vec3(0.2f));
        const Scene scene = plates.builder.build();
        expectAlike(onDevice(plates, scene, 8), onCpu(plates, scene, 8), 0.03);
    }
}

TEST_F(ViewportNearLight, FollowsLightsMaterialsAndLayouts) {
    TwoPlates plates(wall(), 0.6f);
    plates.builder.scene.lights = {sun()};
    plates.setField(0, {0, 1, 0}, glm::vec3(0.5f));
    plates.setField(1, {0, 0, 1}, glm::vec3(0.5f));
    onDevice(plates, plates.builder.build(), 8);
    plates.builder.scene.lights[0].strength = 9;
    expectAlike(onDevice(plates, plates.builder.build(), 8),
                onCpu(plates, plates.builder.build(), 8), 0.04);
    plates.builder.scene.materials[0].baseColor = {0.1f, 0.8f, 0.1f, 1};
    expectAlike(onDevice(plates, plates.builder.build(), 8),
                onCpu(plates, plates.builder.build(), 8), 0.04);
    plates.layout = std::make_shared<LightmapLayout>(*plates.layout);
    plates.layout->instances[1].uv.clear();
    expectAlike(onDevice(plates, plates.builder.build(), 8),
                onCpu(plates, plates.builder.build(), 8), 0.04);
}

} // namespace
} // namespace limn::near_light_device_test
