// SPDX-License-Identifier: MIT
// The sun on scenes much larger than what is looked at: its shadow maps follow the camera.
#include "tests/render/viewport_fixture.h"

#include "engine/picture/field_render.h"
#include "engine/render/shadows/shadow_cascades.h"

#include <algorithm>

namespace limn::shadow_cascades_test {
namespace {

using render::cascadeProjections;
using render::ShadowCamera;

const glm::vec3 kSun = glm::normalize(glm::vec3(-0.8f, -1, -0.3f));
const Bounds kWide{{-100, 0, -100}, {100, 3, 100}};

bool isInside(const glm::mat4& toClip, glm::vec3 p) {
    const glm::vec4 q = toClip * glm::vec4(p, 1);
    return std::abs(q.x) < 1 && std::abs(q.y) < 1 && q.z > 0 && q.z < 1;
}

TEST(ShadowCascades, AreEachFinerThanTheOneBeforeAndHoldWhatIsSeenFromTheEyeOn) {
    for (const float tanCorner : {0.1f, 0.5f, 1.f, 2.f}) {
        const ShadowCamera camera{
            .eye = {3, 1.6f, -7}, .forward = {0, 0, -1}, .tanCorner = tanCorner};
        const auto maps = cascadeProjections(kSun, kWide, camera);
        ASSERT_EQ(maps.size(), render::kMaxCascades);
        float before = 0;
        for (const glm::mat4& map : maps) {
            const float scale = glm::length(glm::vec3(glm::transpose(map)[0])); // 2 / width
            if (before > 0) {
                EXPECT_NEAR(scale / before, render::kCascadeRatio, 1e-4f);
            }
            before = scale;
            // A picture that is 1 deep where its corners are tanCorner off the axis.
            const float depth =
                0.99f / scale / 1.2f / std::max((1 + tanCorner * tanCorner) / 2, tanCorner);
            for (const glm::vec3 corner :
                 {glm::vec3(tanCorner, 0, -1), glm::vec3(-tanCorner, 0, -1),
                  glm::vec3(0, tanCorner, -1), glm::vec3(0, -tanCorner, -1), glm::vec3(0)}) {
                const glm::vec4 q = map * glm::vec4(camera.eye + depth * corner, 1);
                EXPECT_LT(std::max(std::abs(q.x), std::abs(q.y)), 0.95f) << tanCorner;
            }
        }
    }
}

TEST(ShadowCascades, HoldCastersAsFarOffAsTheSceneGoes) {
    const auto maps = cascadeProjections(kSun, {{-100, 0, -100}, {100, 500, 100}}, {});
    ASSERT_FALSE(maps.empty());
    for (const glm::mat4& map : maps)
        EXPECT_TRUE(isInside(map, -kSun * (120 / -kSun.y))); // on the sun's way to the origin
}

TEST(ShadowCascades, StayWhileTheCameraMovesALittleAndStepByWholeTexelsWhenItMovesOn) {
    ShadowCamera camera{.eye = {0, 1.6f, 0}};
    auto before = cascadeProjections(kSun, kWide, camera);
    int kept = 0, moved = 0;
    for (int k = 1; k <= 200; ++k) {
        camera.eye = {0.02f * float(k), 1.6f, 0.01f * float(k)};
        camera.forward = glm::normalize(glm::vec3(0.002f * float(k), 0, -1));
        const auto now = cascadeProjections(kSun, kWide, camera);
        ASSERT_EQ(now.size(), before.size());
        for (std::size_t i = 0; i < now.size(); ++i) {
            kept += now[i] == before[i];
            moved += now[i] != before[i];
            const glm::vec2 step = glm::vec2(now[i][3] - before[i][3]) * 8.f; // sixteenths
            EXPECT_NEAR(step.x, std::round(step.x), 1e-3f);
            EXPECT_NEAR(step.y, std::round(step.y), 1e-3f);
        }
        before = now;
    }
    EXPECT_GT(moved, 20);
    EXPECT_GT(kept, 4 * moved);
}

TEST(ShadowCascades, BeforeAllThatIsInSightAreLeftOut) {
    const auto count = [](float nearest) {
        return cascadeProjections(kSun, kWide, {.nearest = nearest}).size();
    };
    EXPECT_EQ(count(0), render::kMaxCascades);
    EXPECT_LT(count(3), render::kMaxCascades);
    EXPECT_GT(count(3), 0U);
    EXPECT_EQ(count(1000), 0U);
}

TEST(ShadowCascades, FinerThanTheirPixelsNeedAreLeftOut) {
    const auto count = [](float pixel) {
        return cascadeProjections(kSun, kWide, {.nearest = 1, .pixel = pixel}).size();
    };
    const glm::mat4 first = cascadeProjections(kSun, kWide, {})[0];
    const float texel = 2 / (1024 * glm::length(glm::vec3(glm::transpose(first)[0])));
    EXPECT_EQ(count(texel * render::kCascadeRatio / render::kTexelPixels * 1.01f), 0U)
        << "the map of the whole scene does";
    EXPECT_EQ(count(texel / render::kTexelPixels * 1.01f), 1U);
    EXPECT_EQ(count(texel / render::kTexelPixels * 0.99f), 2U);
}

Light sun() {
    Light l;
    l.kind = LightKind::Directional;
    l.direction = kSun;
    l.strength = kPi;
    return l;
}

Material white() {
    Material m = simple::lambert(glm::vec3(0.8f));
    m.doubleSided = true;
    return m;
}

/// A closed room without thickness, 8 m x 3 m x 6 m, on a plane 200 m wide that is its floor.
simple::SceneBuilder closedRoom() {
    simple::SceneBuilder b;
    b.addMaterial(white());
    b.add(simple::quad({-100, 0, 100}, {200, 0, 0}, {0, 0, -200}));
    b.add(simple::quad({-4, 3, -3}, {8, 0, 0}, {0, 0, 6}));
    for (const float x : {-4.f, 4.f})
        b.add(simple::quad({x, 0, -3}, {0, 0, 6}, {0, 3, 0}));
    for (const float z : {-3.f, 3.f})
        b.add(simple::quad({-4, 0, z}, {8, 0, 0}, {0, 3, 0}));
    return b;
}

class SunOnAWidePlane : public ViewportTest {
protected:
    void SetUp() override {
        ViewportTest::SetUp();
        options.width = 160;
        options.height = 96;
    }
    /// rms(drawn - traced) / mean(traced), of pixels of 4 x 4 samples.
    double nrmse(const Scene& scene) {
        constexpr std::uint32_t kSide = 4;
        const ImageF traced = renderField(TraceScene(scene), {}, {},
                                          {.view = View::Direct,
                                           .camera = options.camera,
                                           .width = options.width,
                                           .height = options.height,
                                           .samplesPerPixel = 64});
        options.width *= kSide;
        options.height *= kSide;
        const ImageF drawn = draw(scene, View::Direct);
        double squares = 0, sum = 0;
        for (std::size_t i = 0; i < traced.rgb.size(); ++i) {
            const auto x = std::uint32_t(i) % traced.width, y = std::uint32_t(i) / traced.width;
            double mean = 0;
            for (std::uint32_t k = 0; k < kSide * kSide; ++k)
                mean += double(pixel(drawn, kSide * x + k % kSide, kSide * y + k / kSide).g);
            const double d = mean / (kSide * kSide) - double(traced.rgb[i].g);
            squares += d * d;
            sum += double(traced.rgb[i].g);
        }
        EXPECT_GT(sum, 0);
        return std::sqrt(squares * double(traced.rgb.size())) / sum;
    }
};

TEST_F(SunOnAWidePlane, ShinesIntoNoClosedRoom) {
    simple::SceneBuilder b = closedRoom();
    double mean = 0;
    for (const float turn : {0.f, 1.f, 2.f, 3.f, 4.f, 5.f}) {
        b.scene.lights = {sun()};
        b.scene.lights[0].direction =
            glm::rotate(glm::mat4(1), turn, glm::vec3(0, 1, 0)) * glm::vec4(kSun, 0);
        const Scene scene = b.build();
        for (const glm::vec3 eye : {glm::vec3(3.5f, 1.6f, 2.5f), glm::vec3(-3.5f, 0.8f, -2)}) {
            options.camera = {.eye = eye, .target = {0, 1.4f, 0}, .fovY = 1.2f};
            for (const glm::vec3 p : draw(scene, View::Direct).rgb)
                mean += double(p.g) / (12 * 160 * 96);
        }
    }
    const double outside = 0.8 * double(-kSun.y); // the sunlit ground
    std::printf("inside, of the light outside: %.2e\n", mean / outside);
    // What is left are lines less than a texel wide at the edges of the room: 0.26 % of the light
    // by a map of the whole scene alone, 0.08 % where texels that show what lies far behind count.
    EXPECT_LT(mean / outside, 7e-4);
}

TEST_F(SunOnAWidePlane, ThroughAnArcadeIsThatOfRays) {
    simple::SceneBuilder b;
    b.addMaterial(white());
    b.add(simple::quad({-100, 0, 100}, {200, 0, 0}, {0, 0, -200}));
    b.add(simple::quad({-6, 3, -1.5f}, {12, 0, 0}, {0, 0, 3})); // roof
    b.add(simple::quad({-6, 0, -1.5f}, {12, 0, 0}, {0, 3, 0})); // wall behind
    for (int k = 0; k <= 8; ++k) {
        const float x = 1.5f * float(k) - 6;
        b.add(simple::box({x - 0.15f, 0, 1.2f}, {x + 0.15f, 2.2f, 1.5f}, false));
        // The arch to the next pillar, of seven blocks.
        for (int i = 0; i < 7 && k < 8; ++i) {
            const float t = (float(i) + 0.5f) / 7 * 2 - 1, rise = 0.6f * std::sqrt(1 - t * t);
            b.add(simple::box({x + 0.15f + 1.2f / 7 * float(i), 2.2f + rise, 1.2f},
                              {x + 0.15f + 1.2f / 7 * float(i + 1), 3, 1.5f}, false));
        }
    }
    b.scene.lights = {sun()};
    b.scene.lights[0].direction = glm::normalize(glm::vec3(-0.4f, -0.9f, -0.8f));
    options.camera = {.eye = {5.5f, 1.6f, 0.9f}, .target = {-2, 1, -0.9f}, .fovY = 1};
    const double error = nrmse(b.build());
    RecordProperty("nrmse", std::to_string(error));
    std::printf("nRMSE %.4f\n", error);
    // Edges of light and shadow, blurred over 1.5 texels. The map of the whole scene alone, with
    // texels of 12 cm, has 0.32.
    EXPECT_LT(error, 0.1);
}

TEST_F(SunOnAWidePlane, ACameraThatMovesDrawsCascadesAndNotTheMapOfTheWholeScene) {
    simple::SceneBuilder b = closedRoom();
    b.scene.lights = {sun()};
    const Scene scene = b.build();
    options.camera = {.eye = {0, 1.6f, 1}, .target = {0, 1.6f, 0}};
    draw(scene, View::Direct);
    EXPECT_EQ(viewport->stats().shadowMapsDrawn, 1U);
    options.camera.eye.x = 0.001f;
    draw(scene, View::Direct);
    EXPECT_EQ(viewport->stats().shadowMapsDrawn, 0U) << "within a step";
    const std::uint64_t lights = viewport->shadowedLights().version;
    options.camera.eye = {2, 1.2f, -1};
    options.camera.target = {-1, 1, 1};
    const ImageF there = draw(scene, View::Direct);
    EXPECT_EQ(viewport->stats().shadowMapsDrawn, 1U);
    const ShadowedLights surfels = viewport->shadowedLights();
    EXPECT_EQ(viewport->stats().relightShadowMaps, 0U);
    EXPECT_EQ(surfels.version, lights) << "what lights surfels does not depend on the camera";
    viewport = std::make_unique<Viewport>(*device);
    const ImageF fresh = draw(scene, View::Direct);
    for (std::size_t i = 0; i < there.rgb.size(); ++i)
        ASSERT_EQ(there.rgb[i], fresh.rgb[i]) << "nor on where the camera was before";
}

} // namespace
} // namespace limn::shadow_cascades_test
