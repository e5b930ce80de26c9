// SPDX-License-Identifier: MIT
#include "app/bench/light_place.h"
#include "app/bench/live_light.h"
#include "app/bench/moving_lights.h"
#include "app/bench/smooth_motion.h"
#include "app/bench/techniques_page.h"
#include "app/bench/time_limit.h"
#include "app/bench/timed_updates.h"
#include "engine/lightmap/atlas.h"
#include "engine/techniques/technique_table.h"
#include "tests/app/command_line.h"
#include "tests/core/sweep.h"
#include "tests/trace/simple_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::bench_techniques_test {
namespace {

using limn::Json;

Json row(const char* technique, const char* settings, double ms, double nrmse,
         const char* device = "cpu") {
    return {{"technique", technique},
            {"settings", settings},
            {"device", device},
            {"seconds", 0.5},
            {"bytes", 1 << 20},
            {"light_ms", ms},
            {"color_ms", 1.0},
            {"material_ms", 2.0},
            {"object_ms", nullptr},
            {"camera_ms", 0.5},
            {"nrmse", nrmse},
            {"bias", -0.1},
            {"one_bounce_nrmse", 1.0},
            {"one_bounce_bias", 0.2},
            {"ssim", 0.8},
            {"flip", 0.1},
            {"leak", 0.015},
            {"flicker", -0.002},
            {"camera_flicker", 0.001},
            {"object_flicker", nullptr},
            {"lag", nullptr},
            {"cpu_difference_rms", 0.00012},
            {"cpu_difference_max", nullptr}};
}

TEST(TechniquesPage, TheSmallestErrorWithinABudgetWins) {
    const std::vector<Json> rows = {row("A", "fast", 3, 0.5), row("A", "slow", 30, 0.1),
                                    row("B", "fast", 4, 0.4)};
    EXPECT_EQ(limn::bestWithin(rows, "light_ms", 2), nullptr);
    EXPECT_EQ(limn::bestWithin(rows, "light_ms", 3), &rows[0]);
    EXPECT_EQ(limn::bestWithin(rows, "light_ms", 5), &rows[2]);
    EXPECT_EQ(limn::bestWithin(rows, "light_ms", 33), &rows[1]);
}

TEST(TechniquesPage, NeedsNoOtherFileAndEscapesNames) {
    limn::Image image;
    image.width = image.height = 1;
    image.rgba = {255, 0, 0, 255};
    const auto html =
        limn::techniquesPage({{"a < b",
                               "note",
                               {row("A & Co", "fast", 3, 0.5), row("B", "dark", 0, 1)},
                               {{"red", image}}}},
                             "thin & thick walls");
    ASSERT_TRUE(html);
    EXPECT_NE(html->find("a &lt; b"), std::string::npos);
    EXPECT_NE(html->find("A &amp; Co"), std::string::npos);
    EXPECT_NE(html->find("thin &amp; thick walls"), std::string::npos);
    EXPECT_NE(html->find("<td>0.800</td><td>0.100</td><td>1.50 %</td><td>-0.20 %</td>"
                         "<td>+0.10 %</td><td></td><td></td>"),
              std::string::npos);
    EXPECT_NE(html->find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
    for (const char* outside : {"http:", "https:", "<script", "inf", "nan"})
        EXPECT_EQ(html->find(outside), std::string::npos) << outside;
}

TEST(TechniquesPage, EachDeviceHasItsWinners) {
    const auto html = limn::techniquesPage(
        {{"room", "", {row("A", "s", 1, 0.5), row("B", "s", 1, 0.4, "GPU <1>")}, {}}}, "");
    ASSERT_TRUE(html);
    const std::size_t cpu = html->find("<h3>On cpu</h3>"),
                      gpu = html->find("<h3>On GPU &lt;1&gt;</h3>");
    ASSERT_TRUE(cpu < gpu && gpu != std::string::npos);
    const std::size_t first = html->find("<td>A, s</td><td>0.500</td>"),
                      second = html->find("<td>B, s</td><td>0.400</td>");
    EXPECT_TRUE(cpu < first && first < gpu) << "the slower device's light counts for itself alone";
    EXPECT_TRUE(gpu < second && second != std::string::npos);
    EXPECT_NE(html->find("<td>GPU &lt;1&gt;</td>"), std::string::npos);
    EXPECT_NE(html->find("<td>0.012 %</td><td></td></tr>"), std::string::npos);
}

limn::ImageF grey(std::initializer_list<float> pixels) {
    limn::ImageF image{std::uint32_t(pixels.size()), 1, {}};
    for (const float p : pixels)
        image.rgb.emplace_back(p);
    return image;
}

TEST(LiveLight, FlickerIsTheChangeBeyondThatOfTheTruthWithoutItsNoise) {
    // Every pixel of the truth rises by 1 a frame; its mean over the frames is 10.
    const std::vector<limn::ImageF> truth = {grey({9, 9}), grey({10, 10}), grey({11, 11})};
    EXPECT_NEAR(limn::flickerOf(truth, truth, truth), 0, 1e-6);
    const std::vector<limn::ImageF> twice = {grey({8, 8}), grey({10, 10}), grey({12, 12})};
    EXPECT_NEAR(limn::flickerOf(twice, truth, truth), 0.1, 1e-6);
    const std::vector<limn::ImageF> still = {grey({9, 9}), grey({9, 9}), grey({9, 9})};
    EXPECT_NEAR(limn::flickerOf(still, truth, truth), -0.1, 1e-6);
    // Noise that the two references do not share: the mean product of their changes is still 1.
    const std::vector<limn::ImageF> a = {grey({9, 9}), grey({13, 7}), grey({11, 11})},
                                    b = {grey({9, 9}), grey({13, 13}), grey({11, 11})};
    EXPECT_NEAR(limn::flickerOf(truth, a, b), 0, 1e-6);
    // A truth of one frame does not change.
    const std::vector<limn::ImageF> constant = {grey({4, 6})};
    EXPECT_NEAR(limn::flickerOf(twice, constant, constant), 2. / 5, 1e-6);
}

TEST(LiveLight, DistanceIsRelativeToTheGoal) {
    EXPECT_NEAR(limn::distanceOf(grey({1, 5}), grey({4, 4})), std::sqrt(5.) / 4, 1e-6);
    EXPECT_EQ(limn::distanceOf(grey({0, 0}), grey({0, 0})), 0);
}

/// A room with a lamp in a corner. `block`: with a block that moves.
limn::Scene lampRoom(bool block = false) {
    limn::simple::SceneBuilder b;
    b.addMaterial(limn::simple::lambert(glm::vec3(0.5f)));
    b.add(limn::simple::box(glm::vec3(0), glm::vec3(4), true));
    if (block)
        b.add(limn::simple::box({3, 0, 3}, {3.5f, 1, 3.5f}, false), glm::mat4(1), true);
    b.scene.lights = {{.kind = limn::LightKind::Point, .position = {3.5f, 3.5f, 3.5f}},
                      {.kind = limn::LightKind::Directional, .direction = {0, 0, -1}}};
    return b.build();
}

TEST(LiveLight, LightsMoveTowardsTheMiddleAndTurn) {
    const limn::Scene scene = lampRoom();
    EXPECT_EQ(limn::withLightsMoved(scene, 0).lights, scene.lights);
    const limn::Scene half = limn::withLightsMoved(scene, 0.5f);
    EXPECT_LT(glm::distance(half.lights[0].position, glm::vec3(2.55f, 2.75f, 2.65f)), 1e-5f);
    EXPECT_NEAR(half.lights[1].direction.z, -std::cos(0.5f), 1e-6f);
    EXPECT_NEAR(half.lights[1].direction.x, -std::sin(0.5f), 1e-6f);
    limn::Scene dark = scene;
    dark.lights.clear();
    dark.sky.radiance = glm::vec3(2);
    dark.materials[0].emission = glm::vec3(3);
    const limn::Scene brighter = limn::withLightsMoved(dark, 0.5f);
    EXPECT_EQ(brighter.sky.radiance, glm::vec3(3));
    EXPECT_EQ(brighter.materials[0].emission, glm::vec3(4.5f));
}

/// A wall of 20 m, and before it a pane, which moves, 1 m wide and 2 m high.
limn::Scene paneBeforeWall() {
    limn::simple::SceneBuilder b;
    b.addMaterial(limn::simple::lambert(glm::vec3(0.5f)));
    b.add(limn::simple::quad({-10, -10, 0}, {20, 0, 0}, {0, 20, 0}));
    b.add(limn::simple::quad({-0.5f, -1, 0}, {1, 0, 0}, {0, 2, 0}),
          glm::translate(glm::mat4(1), glm::vec3(0, 0, 2)), true);
    return b.build();
}

/// Number of a pixel's middle and corners for which `inside` holds, where the camera sees them in
/// the plane z = `depth`.
template <class Inside>
int insideOf(const limn::Camera& camera, glm::uvec2 size, std::uint32_t pixel, float depth,
             const Inside& inside) {
    int count = 0;
    const float aspect = float(size.x) / float(size.y);
    for (const glm::vec2 place : {glm::vec2(0.5f), {0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
        const glm::vec2 ndc =
            2.f * (glm::vec2(float(pixel % size.x), float(pixel / size.x)) + place) /
                glm::vec2(size) -
            1.f;
        const glm::vec3 d = limn::rayDirection(camera, aspect, ndc.x, -ndc.y);
        count += inside(camera.eye + d * ((depth - camera.eye.z) / d.z)) ? 1 : 0;
    }
    return count;
}

TEST(SmoothMotion, PixelsAreComparedThatShowTheSameSurfacesInAllFrames) {
    const limn::Scene scene = paneBeforeWall();
    const limn::TraceScene trace(scene);
    limn::ReferenceOptions view{.width = 40, .height = 24};
    view.camera = {.eye = {0.1f, 0.2f, 6}, .target = {0, 0.1f, 0}, .fovY = 0.8f};
    const glm::uvec2 size(view.width, view.height);
    EXPECT_EQ(limn::comparedPixels(limn::Motion::Lights, trace, view).size(), 40U * 24);

    const auto fixed = limn::comparedPixels(limn::Motion::Objects, trace, view);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t pixel = 0; pixel < 40 * 24; ++pixel) {
        bool hidden = false;
        for (int k = 0; k < limn::kMotionFrames; ++k) {
            const glm::vec3 place = limn::motionFrame(limn::Motion::Objects, scene, view.camera, k)
                                        .scene.instances[1]
                                        .toWorld[3];
            hidden |= insideOf(view.camera, size, pixel, place.z, [&](glm::vec3 p) {
                          return std::abs(p.x - place.x) < 0.5f && std::abs(p.y - place.y) < 1;
                      }) > 0;
        }
        if (!hidden)
            expected.push_back(pixel);
    }
    EXPECT_EQ(fixed, expected);
    EXPECT_LT(fixed.size(), 40U * 24 - 30) << "the pane is somewhere";

    // Without the pane, the camera's turn alone decides.
    limn::Scene bare = scene;
    bare.instances.pop_back();
    const limn::TraceScene wall(bare);
    const auto seen = limn::comparedPixels(limn::Motion::Camera, wall, view);
    expected.clear();
    for (std::uint32_t pixel = 0; pixel < 40 * 24; ++pixel) {
        int shown = 0;
        for (int k = 1; k < limn::kMotionFrames; ++k) {
            const limn::Camera camera =
                limn::motionFrame(limn::Motion::Camera, bare, view.camera, k).camera;
            const glm::mat4 toClip =
                limn::projectionMatrix(camera, 40.f / 24, 0.1f, 100) * limn::viewMatrix(camera);
            shown += insideOf(view.camera, size, pixel, 0, [&](glm::vec3 p) {
                const glm::vec4 clip = toClip * glm::vec4(p, 1);
                return std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w;
            });
        }
        if (shown == 5 * (limn::kMotionFrames - 1))
            expected.push_back(pixel);
    }
    EXPECT_EQ(seen, expected);
    EXPECT_LT(seen.size(), 40U * 24 - 24) << "a column is lost";
    EXPECT_GT(seen.size(), 40U * 24 / 2);
    // What the pane hides from one of the cameras is not compared.
    EXPECT_LT(limn::comparedPixels(limn::Motion::Camera, trace, view).size(), seen.size());
}

TEST(MovingLights, StandOverEqualAreasOfTheStaticSurfaces) {
    limn::simple::SceneBuilder b;
    b.addMaterial(limn::simple::lambert(glm::vec3(0.5f)));
    b.add(limn::simple::quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}));
    b.add(limn::simple::quad({5, 0, 0}, {0, 0, 3}, {1, 0, 0}));
    b.add(limn::simple::quad({9, 0, 0}, {0, 0, 9}, {9, 0, 0}), glm::mat4(1), true);
    const limn::Scene scene = b.build();
    const limn::SurfacePoints points = limn::spreadPoints(scene, 40);
    ASSERT_EQ(points.positions.size(), 40U);
    EXPECT_EQ(std::ranges::count_if(points.positions, [](glm::vec3 p) { return p.x < 2; }), 10);
    for (const glm::vec3 n : points.normals)
        EXPECT_EQ(n, glm::vec3(0, 1, 0));
    const auto lights = limn::pointsOver(scene, points.positions, points.normals, 7);
    ASSERT_EQ(lights.size(), 7U);
    for (const limn::Light& light : lights)
        EXPECT_NEAR(light.position.y, 0.05f * glm::length(scene.bounds.size()), 1e-5f);
    EXPECT_TRUE(limn::spreadPoints(limn::Scene{}, 3).positions.empty());
}

TEST(LiveLight, ProbesThatTakeTurnsLagAndThoseThatDoNotFollowAtOnce) {
    limn::Scene scene = lampRoom();
    const limn::TraceScene trace(scene);
    const limn::LightmapLayout layout = limn::layoutWithoutLightmap(scene);
    limn::FieldRenderOptions view{.view = limn::View::Irradiance, .width = 16, .height = 12};
    view.camera.eye = glm::vec3(0.5f, 2, 2);
    view.camera.target = glm::vec3(3, 1, 2);
    const auto lag = [&](double perUpdate) {
        scene.technique = {
            "probes", {{"probes.count", 64}, {"probes.side", 12}, {"probes.perUpdate", perUpdate}}};
        return limn::LiveLight(limn::findTechnique("probes")->light({}), scene, trace, layout, view)
            .lag();
    };
    EXPECT_EQ(lag(64), 1U);
    const auto slow = lag(4);
    ASSERT_TRUE(slow);
    EXPECT_GT(*slow, 8U);
    EXPECT_LE(*slow, 64U / 4);
}

/// Light that says that updates took the milliseconds of a list, over and over, and remembers what
/// it was asked for. It is on no CPU.
class ListedLight : public limn::Lighting {
public:
    struct Asked {
        limn::Scene scene;
        std::uint32_t bounces;
        std::optional<limn::Viewpoint> view;
    };
    explicit ListedLight(std::vector<double> ms) : m_ms(std::move(ms)) {}

    limn::LightingReport update(const limn::LightingInput& input, const limn::Progress&) override {
        asked.push_back(
            {input.scene, input.bounces, input.view ? std::optional(*input.view) : std::nullopt});
        return {.totalMs = m_ms[(asked.size() - 1) % m_ms.size()]};
    }
    const limn::IndirectField* field() const override { return nullptr; }
    limn::IndirectField readField() const override {
        limn::IndirectField field;
        field.gridSize = glm::uvec3(1);
        field.gridBounds = {glm::vec3(0), glm::vec3(4)};
        field.grid.assign(field.coefficients(), glm::vec4(0));
        field.grid[0] = glm::vec4(1, 2, 3, 0);
        return field;
    }

    std::vector<Asked> asked;

private:
    std::vector<double> m_ms;
};

/// Light for the eye of a camera, or for where the first dynamic object is: the same everywhere.
class FollowingLight : public ListedLight {
public:
    explicit FollowingLight(bool ofView) : ListedLight({1}), m_ofView(ofView) {}

    limn::LightingReport update(const limn::LightingInput& input,
                                const limn::Progress& progress) override {
        const auto& objects = input.trace->scene().instances;
        const auto object = std::ranges::find_if(objects, &limn::Instance::dynamic);
        m_value = 3 + (m_ofView ? input.view->camera.eye.z : object->toWorld[3].x);
        limn::LightingReport report = ListedLight::update(input, progress);
        report.converged = true;
        return report;
    }
    limn::IndirectField readField() const override {
        limn::IndirectField field = ListedLight::readField();
        field.grid[0] = glm::vec4(glm::vec3(m_value), 0) / std::sqrt(std::numbers::pi_v<float> / 4);
        return field;
    }
    bool isOfView() const override { return m_ofView; }

private:
    bool m_ofView;
    float m_value = 0;
};

TEST(LiveLight, FlickersWithWhatMoves) {
    const limn::Scene scene = lampRoom(true);
    const limn::TraceScene trace(scene);
    const limn::LightmapLayout layout = limn::layoutWithoutLightmap(scene);
    limn::FieldRenderOptions view{.view = limn::View::Irradiance, .width = 12, .height = 8};
    view.camera = {.eye = {0.5f, 2, 2}, .target = {3, 1, 2}};
    const auto flicker = [&](limn::Motion motion, bool ofView) {
        limn::ReferenceOptions size{.width = 12, .height = 8};
        size.camera = view.camera;
        limn::MotionTruth truth{motion, limn::comparedPixels(motion, trace, size), {}, {}};
        EXPECT_GT(truth.pixels.size(), 12U);
        const limn::ImageF constant{std::uint32_t(truth.pixels.size()), 1,
                                    std::vector<glm::vec3>(truth.pixels.size(), glm::vec3(5))};
        truth.first = truth.second = {constant};
        return limn::LiveLight(std::make_unique<FollowingLight>(ofView), scene, trace, layout, view)
            .flicker(truth);
    };
    const double diagonal = double(glm::length(scene.bounds.size()));
    // The camera looks along x, nearly: to its right is z.
    EXPECT_NEAR(*flicker(limn::Motion::Camera, true), 0.002 * diagonal / 5, 1e-4 * diagonal / 5);
    EXPECT_EQ(*flicker(limn::Motion::Camera, false), 0) << "no view changes this light";
    double squares = 0;
    for (int k = 1; k < limn::kMotionFrames; ++k)
        squares += std::pow(std::sin(0.1 * k) - std::sin(0.1 * (k - 1)), 2);
    EXPECT_NEAR(*flicker(limn::Motion::Objects, false),
                0.05 * diagonal * std::sqrt(squares / (limn::kMotionFrames - 1)) / 5, 1e-5);
    EXPECT_EQ(*flicker(limn::Motion::Objects, true), 0) << "the camera stands";
}

TEST(TimedUpdates, MediansCountAndTheSceneIsAsBefore) {
    limn::Scene scene = lampRoom();
    const limn::TraceScene trace(scene);
    const limn::Viewpoint view{{.eye = {0.5f, 2, 2}, .target = {3, 1, 2}}, 1};
    ListedLight light({5, 1, 9, 100}); // after three updates, one that brings the scene back
    const limn::UpdateTimes times = limn::timeUpdates(light, scene, trace, view, {.maxRuns = 3});
    EXPECT_EQ(times.light, 5);
    EXPECT_EQ(times.color, 5);
    EXPECT_EQ(times.material, 5);
    EXPECT_FALSE(times.object) << "nothing is dynamic";
    // Of 5, 1, 9, 100, 5 and 1 every second one is that after the camera turned.
    EXPECT_EQ(times.camera, 1);
    ASSERT_EQ(light.asked.size(), 3 * 4 + 2 * 3 + 1U);
    EXPECT_NE(light.asked[0].scene.lights, scene.lights);
    EXPECT_NE(light.asked[8].scene.materials[0].baseColor, scene.materials[0].baseColor);
    for (const std::size_t back : {3, 7, 11, 18}) {
        EXPECT_EQ(light.asked[back].scene.lights, scene.lights);
        EXPECT_FALSE(light.asked[back].view);
    }
    for (const std::size_t look : {12, 14, 16}) {
        const auto &here = light.asked[look], &aside = light.asked[look + 1];
        ASSERT_TRUE(here.view && aside.view);
        EXPECT_EQ(here.view->camera.target, view.camera.target);
        EXPECT_NEAR(glm::distance(aside.view->camera.target, view.camera.eye),
                    glm::distance(view.camera.target, view.camera.eye), 1e-4f);
        EXPECT_GT(glm::distance(aside.view->camera.target, view.camera.target), 0.5f);
        EXPECT_EQ(aside.bounces, 0U) << "only what has come into view";
        EXPECT_EQ(here.scene.lights, aside.scene.lights);
    }
    scene.instances[0].dynamic = true;
    limn::Scene dark = scene;
    dark.lights.clear();
    ListedLight of({1});
    EXPECT_FALSE(limn::timeUpdates(of, dark, trace, view, {.maxRuns = 3}).color);
    EXPECT_EQ(of.asked.size(), 3 * 4 + 2 * 3 + 1U) << "light, material and object, then the camera";
    ListedLight moved({5, 1, 9, 100});
    EXPECT_EQ(limn::timeUpdates(moved, scene, trace, view, {.maxRuns = 3}).object, 5);
    EXPECT_NE(moved.asked[12].scene.instances[0].toWorld, scene.instances[0].toWorld);
}

TEST(TimedUpdates, EndWhenTheyHaveTakenLongEnough) {
    const limn::Scene scene = lampRoom();
    const limn::TraceScene trace(scene);
    ListedLight light({40});
    limn::timeUpdates(light, scene, trace, {}, {.maxRuns = 100, .enoughMs = 100});
    EXPECT_EQ(light.asked.size(), 3 * (3 + 1) + 2 * 3 + 1U) << "three updates of 40 ms are enough";
}

TEST(TimeLimit, EndsWhatItWatchesOrNothing) {
    const limn::TimeLimit never({});
    EXPECT_FALSE(never.over());
    EXPECT_FALSE(never.progress().cancelled());
    const limn::TimeLimit now(0.);
    while (!now.over()) { // the test's own limit ends it otherwise
    }
    EXPECT_TRUE(now.progress().cancelled());
    const limn::TimeLimit hour(3600); // does not keep its owner waiting
    EXPECT_FALSE(hour.progress().cancelled());
}

TEST(LightPlace, LightThatIsOnNoCpuIsReadBack) {
    const limn::Scene scene = lampRoom();
    const limn::TraceScene trace(scene);
    const limn::LightmapLayout layout = limn::layoutWithoutLightmap(scene);
    limn::FieldRenderOptions view{.view = limn::View::Irradiance, .width = 4, .height = 4};
    view.camera = {.eye = {0.5f, 2, 2}, .target = {3, 1, 2}};
    const limn::ImageF picture = limn::renderLight(trace, ListedLight({1}), layout, view);
    for (const glm::vec3 E : picture.rgb) { // that of radiance c_0 Y_0 from all around
        EXPECT_NEAR(E.x, std::sqrt(std::numbers::pi_v<float> / 4), 1e-4f);
        EXPECT_NEAR(E.z, 3 * std::sqrt(std::numbers::pi_v<float> / 4), 1e-4f);
    }
}

#ifdef LIMN_HAS_VIEWPORT
TEST_F(CommandLine, BenchTechniquesMeasuresOnADeviceToo) {
    const std::string start =
        "bench techniques generated:2 --width 16 --height 12 --spp 8 --runs 1 "
        "--json -o " +
        path("rivals") + " --technique ";
    const nlohmann::json both = json(start + "ambient,probes --relight both --seconds 5");
    // The device lights by one of them. Settings that have begun are measured in both places.
    ASSERT_GE(both["rows"].size(), 3U);
    ASSERT_EQ(both["rows"].size() % 2, 1U);
    EXPECT_EQ(both["rows"][0]["device"], "cpu");
    for (std::size_t k = 1; k < both["rows"].size(); k += 2) {
        const auto &cpu = both["rows"][k], &gpu = both["rows"][k + 1];
        EXPECT_EQ(cpu["device"], "cpu");
        EXPECT_NE(gpu["device"], "cpu");
        EXPECT_EQ(cpu["settings"], gpu["settings"]);
        EXPECT_TRUE(cpu["cpu_difference_rms"].is_null());
        EXPECT_LT(gpu["cpu_difference_rms"].get<double>(), 0.05) << gpu;
        EXPECT_GE(gpu["cpu_difference_max"], gpu["cpu_difference_rms"]) << gpu;
        EXPECT_GT(gpu["bytes"], 0);
        for (const char* ms : {"light_ms", "material_ms", "camera_ms"})
            EXPECT_GE(gpu[ms].get<double>(), 0) << ms;
    }
    EXPECT_EQ(json(start + "ambient --relight gpu")["rows"].size(), 0U);
    EXPECT_NE(contents(path("rivals/techniques.html")).find("Ambient does not light on"),
              std::string::npos);
    EXPECT_EQ(limn(start + "lpv --relight gpu --device no-such-device").exit, 1);
}

TEST_F(CommandLine, BenchTechniquesSaysWhereThereIsNoDevice) {
    const std::string start =
        "bench techniques generated:2 --technique ambient --width 8 --height 8 "
        "--spp 4 --runs 1 --json -o " +
        path("rivals");
    ASSERT_EQ(setenv("VK_ICD_FILENAMES", "/nothing", 1), 0);
    ASSERT_EQ(setenv("VK_DRIVER_FILES", "/nothing", 1), 0);
    const Outcome run = limn(start);
    EXPECT_EQ(run.exit, 0) << run.err;
    EXPECT_NE(run.err.find("measuring on the CPU only"), std::string::npos) << run.err;
    expectRefusal(start + " --relight gpu", "--relight");
    unsetenv("VK_ICD_FILENAMES");
    unsetenv("VK_DRIVER_FILES");
}
#endif

TEST_F(CommandLine, BenchTechniquesSkipsWhatDoesNotFitIntoItsTime) {
    const std::string out = path("short");
    const nlohmann::json result =
        json("bench techniques cornell --relight cpu --technique illuminance,ambient --width 16 "
             "--height 12 --spp 8 --seconds 0.1 --json -o " +
             out);
    EXPECT_LT(result["rows"].size(), 4U);
    for (const auto& r : result["rows"])
        EXPECT_EQ(r["technique"], "Ambient") << "no bake ends in 30 ms";
    EXPECT_NE(contents(out + "/techniques.html").find("Skipped: Illuminance composition, draft"),
              std::string::npos);
}

TEST_F(CommandLine, BenchTechniquesVariesSettingsSizesAndLights) {
    const std::string start = "bench techniques generated:2 --technique probes --relight cpu "
                              "--spp 4 --runs 1 --json -o " +
                              path("varied");
    const nlohmann::json result = json(
        start + " --vary probes.count=27 --vary probes.side=8,12 --size 8x6,16x12 --lights 0,3");
    ASSERT_EQ(result["rows"].size(), 8U);
    const auto& first = result["rows"][0];
    EXPECT_EQ(first["settings"], "count 27, side 8");
    EXPECT_EQ(first["width"], 8);
    EXPECT_EQ(first["height"], 6);
    EXPECT_EQ(result["rows"][1]["settings"], "count 27, side 12");
    EXPECT_EQ(result["rows"][1]["scene"], first["scene"]);
    EXPECT_EQ(result["rows"][2]["lights"], 3);
    EXPECT_NE(result["rows"][2]["scene"], first["scene"]);
    EXPECT_EQ(result["rows"][4]["width"], 16);
    EXPECT_EQ(limn(start + " --vary probes.nothing=3").exit, 2);
    EXPECT_EQ(limn(start + " --size 8").exit, 2);
    EXPECT_EQ(limn(start + " --lights -1").exit, 2);
}

TEST_F(CommandLine, BenchTechniquesMeasuresWhatIsAskedAndWritesAPage) {
    if (limn::kSanitized)
        GTEST_SKIP() << limn::kSweepSkipped;
    const nlohmann::json result =
        json("bench techniques generated:2 --technique ambient,probes --width 16 --height 12 "
             "--relight cpu --spp 8 --runs 1 --json -o " +
             path("rivals"));
    ASSERT_EQ(result["rows"].size(), 6U) << "ambient's default and five sizes of probes";
    EXPECT_EQ(result["rows"][0]["technique"], "Ambient");
    EXPECT_EQ(result["rows"][5]["settings"], "count 1024");
    EXPECT_GT(result["rows"][5]["bytes"], result["rows"][1]["bytes"]);
    for (const auto& r : result["rows"]) {
        EXPECT_GE(r["nrmse"].get<double>(), 0);
        EXPECT_TRUE(r["ssim"] > 0 && r["ssim"] <= 1) << r;
        EXPECT_TRUE(r["flip"] > 0 && r["flip"] < 1) << r;
        EXPECT_GE(r["leak"].get<double>(), 0) << r;
        EXPECT_TRUE(r["flicker"].is_number()) << r;
        EXPECT_EQ(r["camera_flicker"], 0) << "neither light is of a view";
        EXPECT_TRUE(r["object_flicker"].is_null()) << "nothing is dynamic";
    }
    EXPECT_EQ(result["rows"][0]["lag"], 1) << "a constant follows at once";
    EXPECT_GT(result["rows"][5]["lag"], result["rows"][1]["lag"])
        << "two probes an update: more probes take longer";
    for (const char* file : {"techniques.csv", "techniques.json", "techniques.html"})
        EXPECT_GT(std::filesystem::file_size(path("rivals/") + file), 100U) << file;
    EXPECT_EQ(limn("bench techniques generated:2 --technique magic -o " + path("none")).exit, 2);
    EXPECT_EQ(limn("bench techniques nothing.gltf -o " + path("none")).exit, 1);
}

} // namespace
} // namespace limn::bench_techniques_test
