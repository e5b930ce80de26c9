// SPDX-License-Identifier: MIT
#include "engine/trace/rectangle_shadow.h"
#include "tests/render/viewport_fixture.h"
#include "tests/techniques/illuminance/gpu/relit_scene.h"

#include <utility>

namespace limn::gpu_surfel_light_test {
namespace {

/// A court with one light, whose surfels reflect half of what they get.
class ViewportSurfelLight : public ViewportTest {
protected:
    void prepare(const Scene& lit) {
        scene = lit;
        trace = std::make_unique<TraceScene>(scene);
        made = baked(*trace, scene.bake);
        relighter = gpuRelighter(*device, made);
        const std::size_t surfels = made->surfels.size();
        half.albedo.assign(surfels, glm::vec3(0.5f));
        half.emitted.assign(surfels, glm::vec3(0));
        half.sky.assign(made->tree.skyCells, glm::vec3(0));
    }
    /// By the shadow maps of the viewport.
    std::vector<glm::vec3> irradiance() {
        viewport->setScene(scene, nullptr);
        lights = viewport->shadowedLights();
        SurfelInputs inputs = half.inputs();
        inputs.lights = &lights;
        inputs.settings.maxBounces = 1; // from no bounced light at all
        stats = relighter->relight(inputs, 1);
        std::vector<glm::vec3> E = relighter->readRadiosity();
        E.resize(made->surfels.size());
        for (glm::vec3& e : E)
            e *= 2.f;
        return E;
    }
    std::vector<glm::vec3> traced() const { return surfelValues(*made, scene, *trace).direct; }

    Scene scene;
    std::unique_ptr<TraceScene> trace;
    std::shared_ptr<Bake> made;
    std::unique_ptr<GpuRelighter> relighter;
    SurfelValues half;
    ShadowedLights lights;
    GpuRelightStats stats;
};

Light lightOf(LightKind kind) {
    Light l;
    l.kind = kind;
    l.position = {3.4f, 2.6f, 4.5f};
    l.direction = glm::normalize(glm::vec3(-0.6f, -0.7f, -0.5f));
    l.color = {1, 0.5f, 0.25f};
    l.strength = 8;
    l.innerAngle = 0.3f;
    l.outerAngle = 0.9f;
    l.size = {1.2f, 0.8f};
    return l;
}

TEST_F(ViewportSurfelLight, IsThatOfRaysWhereNothingCastsAShadow) {
    for (const LightKind kind :
         {LightKind::Directional, LightKind::Point, LightKind::Spot, LightKind::Rectangle}) {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.5f)));
        b.add(simple::quad({0, 0, 5}, {4, 0, 0}, {0, 0, -5}));
        Scene open = b.build();
        open.bake = court().bake;
        open.lights = {lightOf(kind)};
        prepare(open);
        const std::vector<glm::vec3> E = irradiance(), expected = traced();
        float largest = 0;
        for (const glm::vec3 e : expected)
            largest = std::max(largest, e.x);
        ASSERT_GT(largest, 0.1f);
        for (std::size_t i = 0; i < E.size(); ++i)
            for (int k = 0; k < 3; ++k) // the tent's weights sum to 1 up to rounding
                ASSERT_NEAR(E[i][k], expected[i][k], 1e-5f * largest) << i;
    }
}

TEST_F(ViewportSurfelLight, DiffersFromThatOfRaysOnlyAtTheEdgesOfShadows) {
    for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot}) {
        Scene shaded = court();
        shaded.lights = {lightOf(kind)};
        shaded.bake.surfels = 1500;
        prepare(shaded);
        const std::vector<glm::vec3> E = irradiance(), expected = traced();
        std::size_t lit = 0, dark = 0, differ = 0;
        for (std::size_t i = 0; i < E.size(); ++i) {
            lit += expected[i].x > 0;
            dark += expected[i].x == 0;
            differ += std::abs(E[i].x - expected[i].x) > 0.01f * std::max(expected[i].x, 0.1f);
        }
        std::printf("kind %d: %zu lit, %zu dark, %zu differ\n", int(kind), lit, dark, differ);
        EXPECT_GT(lit, 300U);
        EXPECT_GT(dark, 300U);
        EXPECT_LT(differ, kLightPoints * E.size() / 100)
            << int(kind); // of points, one in a hundred
    }
}

/// Error against rays to 1024 points of the rectangle, per mean irradiance.
struct ShadowError {
    double nrmse = 0, bias = 0;
};
ShadowError errorOf(const std::vector<glm::vec3>& E, const std::vector<float>& truth) {
    double squares = 0, sum = 0, difference = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double d = double(E[i].x - truth[i]);
        squares += d * d;
        difference += d;
        sum += double(truth[i]);
    }
    return {std::sqrt(squares * double(truth.size())) / sum, difference / sum};
}

TEST_F(ViewportSurfelLight, ThatOfARectangleDiffersFromThatOfRaysByTheNoiseOfItsShadow) {
    Scene shaded = court();
    shaded.lights = {lightOf(LightKind::Rectangle)};
    shaded.bake.surfels = 1500;
    prepare(shaded);
    const LightRectangle rectangle = lightRectangle(shaded.lights[0]);
    std::vector<float> truth;
    std::uint64_t rays = 0;
    const std::vector<glm::vec3>&at = made->surfels.lightPoints,
          &normal = made->surfels.lightNormals;
    const auto meanOver = [&](std::size_t surfel, const auto& lightAt) {
        float sum = 0;
        for (std::size_t k = 0; k < kLightPoints; ++k)
            sum += lightAt(at[surfel * kLightPoints + k], normal[surfel * kLightPoints + k]);
        return sum / float(kLightPoints);
    };
    for (std::size_t i = 0; i < made->surfels.size(); ++i)
        truth.push_back(shaded.lights[0].color.x * shaded.lights[0].strength *
                        meanOver(i, [&](glm::vec3 p, glm::vec3 n) {
                            return shadowedIrradiance(*trace, rectangle,
                                                      RectangleReceiver::flat(p, n), 1024,
                                                      {0.3f, 0.7f}, rays);
                        }));
    const ShadowError gpu = errorOf(irradiance(), truth), cpu = errorOf(traced(), truth);
    std::printf("against 1024 rays: GPU nRMSE %.4f, bias %+.4f; CPU nRMSE %.4f, bias %+.4f\n",
                gpu.nrmse, gpu.bias, cpu.nrmse, cpu.bias);
    // Shadows from the depths that four points of the rectangle see, as in the viewport's pixels.
    EXPECT_LT(gpu.nrmse, 0.06);
    EXPECT_LT(std::abs(gpu.bias), 0.01);
    std::vector<glm::vec3> unshadowed;
    for (std::size_t i = 0; i < truth.size(); ++i)
        unshadowed.push_back(shaded.lights[0].color * shaded.lights[0].strength *
                             meanOver(i, [&](glm::vec3 q, glm::vec3 n) {
                                 return rectangleIrradiance(rectangle, q, n);
                             }));
    EXPECT_GT(errorOf(unshadowed, truth).nrmse, 4 * gpu.nrmse) << "what the shadow is worth";
}

TEST_F(ViewportSurfelLight, LightsAddUpAndAreWorkedOutOnlyWhenTheyChange) {
    Scene three = court();
    three.lights = {lightOf(LightKind::Directional), lightOf(LightKind::Point),
                    lightOf(LightKind::Spot)};
    prepare(three);
    const std::vector<glm::vec3> all = irradiance();
    EXPECT_GT(stats.dispatches, 0U);
    std::vector<glm::vec3> sum(all.size(), glm::vec3(0));
    for (const Light& light : three.lights) {
        scene.lights = {light};
        relighter = gpuRelighter(*device, made);
        const std::vector<glm::vec3> one = irradiance();
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += one[i];
    }
    // Maps lie elsewhere in the atlas: of 2048 texels, 24 bits keep a place to 2^-13 of a texel,
    // over which a share of 1 fades by less than twice that.
    float largest = 0;
    for (const glm::vec3 e : sum)
        largest = std::max(largest, e.x);
    for (std::size_t i = 0; i < sum.size(); ++i)
        ASSERT_NEAR(all[i].x, sum[i].x, 0x1p-12f * largest);
    SurfelInputs inputs = half.inputs();
    inputs.lights = &lights;
    relighter->relight(inputs, 200);
    lights = viewport->shadowedLights();
    EXPECT_TRUE(relighter->relight(inputs, 200).skipped);
    const float before = relighter->readRadiosity()[0].x;
    ASSERT_EQ(scene.lights.size(), 1U);
    scene.lights[0].color = {0, 1, 0};
    viewport->setLighting(scene);
    lights = viewport->shadowedLights();
    EXPECT_FALSE(relighter->relight(inputs, 200).skipped);
    EXPECT_LT(relighter->readRadiosity()[0].x, 1e-3f * before);
}

/// All kinds.
Scene manyLights() {
    Scene scene = court();
    scene.lights.clear();
    for (const LightKind kind :
         {LightKind::Directional, LightKind::Point, LightKind::Spot, LightKind::Rectangle})
        scene.lights.push_back(lightOf(kind));
    return scene;
}

TEST_F(ViewportSurfelLight, OnlyLightsThatMoveOrChangeTheirShapeAreWorkedOutAnew) {
    prepare(manyLights());
    std::vector<glm::vec3> before;
    const auto expect = [&](std::uint32_t traced, std::uint32_t maps, const char* what) {
        const std::vector<glm::vec3> E = irradiance();
        EXPECT_FALSE(E == before) << what;
        EXPECT_EQ(stats.lightsTraced, traced) << what;
        EXPECT_EQ(viewport->stats().relightShadowMaps, maps) << what;
        std::unique_ptr<GpuRelighter> kept = std::exchange(relighter, gpuRelighter(*device, made));
        EXPECT_TRUE(irradiance() == E) << what << ": as if nothing had been kept";
        relighter = std::move(kept);
        before = E;
    };
    expect(4, 4, "at first");
    for (Light& l : scene.lights)
        l.color = {0.2f, 1, 0.7f};
    scene.lights[2].strength *= 3;
    expect(0, 0, "colour and strength");
    scene.lights[1].position.x -= 0.5f;
    expect(1, 1, "one moved");
    scene.lights[1].range = 4;
    expect(1, 0, "range, which moves no shadow");
    scene.lights[0].enabled = false;
    expect(0, 0, "one off");
    std::swap(scene.lights[1], scene.lights[3]);
    scene.lights[2].strength = 1;
    expect(0, 0, "another order");
    scene.lights[0].enabled = true;
    expect(1, 1, "on again");
    scene.instances[4].toWorld[3].x += 0.3f;
    expect(4, 4, "an object moved");
}

TEST_F(ViewportSurfelLight, LightsBeyondTheRoomForThemAreWorkedOutEachTime) {
    prepare(manyLights());
    const std::vector<glm::vec3> all = irradiance();
    relighter = gpuRelighter(*device, made);
    device->properties.limits.maxStorageBufferRange =
        std::uint32_t(2 * made->surfels.size() * sizeof(float));
    const std::vector<glm::vec3> few = irradiance();
    EXPECT_EQ(stats.lightsTraced, 4U);
    float largest = 0;
    for (const glm::vec3 e : all)
        largest = std::max(largest, e.x);
    for (std::size_t i = 0; i < all.size(); ++i) // four terms in another order
        ASSERT_NEAR(few[i].x, all[i].x, 0x1p-22f * largest);
    for (const float strength : {2.f, 8.f}) { // 8: as it was
        for (Light& l : scene.lights)
            l.strength = strength;
        EXPECT_EQ(irradiance() == few, strength == 8);
        EXPECT_EQ(stats.lightsTraced, 2U);
    }
}

TEST_F(ViewportSurfelLight, OfManyLightsNoneIsLeftOutOrTakenTwice) {
    Scene one = court();
    one.lights = {lightOf(LightKind::Spot)};
    prepare(one);
    const std::vector<glm::vec3> E = irradiance();
    float largest = 0;
    for (const glm::vec3 e : E)
        largest = std::max(largest, e.x);
    constexpr std::uint32_t kLights = 37;
    scene.lights.resize(kLights, scene.lights[0]);
    const std::uint32_t whole = device->properties.limits.maxStorageBufferRange;
    for (const std::uint32_t room : {2 * kLights, 2U}) {
        device->properties.limits.maxStorageBufferRange = whole;
        relighter = gpuRelighter(*device, made);
        device->properties.limits.maxStorageBufferRange =
            room * std::uint32_t(made->surfels.size() * sizeof(float));
        for (int call = 0; call < 2; ++call) { // the second time kept lights are there
            scene.lights.back().color.x = call == 0 ? 1 : 2;
            const std::vector<glm::vec3> all = irradiance();
            const float sum = float(kLights) + float(call);
            EXPECT_EQ(stats.lightsTraced, call == 0 ? kLights : room > 2 ? 0 : kLights - 2);
            for (std::size_t i = 0; i < E.size(); ++i) // maps lie elsewhere, as above
                ASSERT_NEAR(all[i].x, sum * E[i].x, 0x1p-12f * sum * largest) << i;
        }
    }
}

TEST_F(ViewportSurfelLight, GivesWayToNumbersAndComesBack) {
    prepare(court());
    half.direct.assign(made->surfels.size(), glm::vec3(0));
    const std::vector<glm::vec3> lit = irradiance();
    const auto brightest = std::size_t(
        std::ranges::max_element(lit, {}, [](glm::vec3 e) { return e.x; }) - lit.begin());
    const auto numbers = [&] {
        const bool skipped = relighter->relight(half.inputs(), 200).skipped;
        return skipped ? -1.f : relighter->readRadiosity()[brightest].x;
    };
    const float value = lit[brightest].x;
    ASSERT_GT(value, 0);
    for (int round = 0; round < 2; ++round) {
        EXPECT_NEAR(numbers(), 0, 1e-3f * value) << round;
        EXPECT_GE(irradiance()[brightest].x, value) << round;
    }
}

TEST_F(ViewportSurfelLight, NoLightIsBlack) {
    Scene dark = court();
    dark.lights.clear();
    prepare(dark);
    for (const glm::vec3 e : irradiance())
        ASSERT_EQ(e, glm::vec3(0));
}

TEST_F(ViewportSurfelLight, FramesDrawNoShadowMapAgain) {
    prepare(court());
    viewport->setScene(scene, nullptr);
    viewport->shadowedLights();
    options.view = View::Direct;
    viewport->render(options);
    EXPECT_EQ(viewport->stats().shadowMapsDrawn, 0U);
    scene.lights[0].position.x -= 1;
    viewport->setLighting(scene);
    viewport->render(options);
    EXPECT_EQ(viewport->stats().shadowMapsDrawn, 1U);
}

} // namespace
} // namespace limn::gpu_surfel_light_test
