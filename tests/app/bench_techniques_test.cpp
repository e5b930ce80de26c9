// SPDX-License-Identifier: MIT
#include "app/bench/live_light.h"
#include "app/bench/techniques_page.h"
#include "engine/lightmap/atlas.h"
#include "engine/techniques/technique_table.h"
#include "tests/app/command_line.h"
#include "tests/trace/simple_scene.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace {

using limn::Json;

Json row(const char* technique, const char* settings, double ms, double nrmse) {
    return {{"technique", technique},
            {"settings", settings},
            {"seconds", 0.5},
            {"bytes", 1 << 20},
            {"light_ms", ms},
            {"color_ms", 1.0},
            {"material_ms", 2.0},
            {"object_ms", nullptr},
            {"nrmse", nrmse},
            {"bias", -0.1},
            {"one_bounce_nrmse", 1.0},
            {"one_bounce_bias", 0.2},
            {"ssim", 0.8},
            {"flip", 0.1},
            {"leak", 0.015},
            {"flicker", -0.002},
            {"lag", nullptr}};
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
    EXPECT_NE(html->find("<td>0.800</td><td>0.100</td><td>1.50 %</td><td>-0.20 %</td><td></td>"),
              std::string::npos);
    EXPECT_NE(html->find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
    for (const char* outside : {"http:", "https:", "<script", "inf", "nan"})
        EXPECT_EQ(html->find(outside), std::string::npos) << outside;
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
}

TEST(LiveLight, DistanceIsRelativeToTheGoal) {
    EXPECT_NEAR(limn::distanceOf(grey({1, 5}), grey({4, 4})), std::sqrt(5.) / 4, 1e-6);
    EXPECT_EQ(limn::distanceOf(grey({0, 0}), grey({0, 0})), 0);
}

/// A room with a lamp in a corner.
limn::Scene lampRoom() {
    limn::simple::SceneBuilder b;
    b.addMaterial(limn::simple::lambert(glm::vec3(0.5f)));
    b.add(limn::simple::box(glm::vec3(0), glm::vec3(4), true));
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

TEST_F(CommandLine, BenchTechniquesMeasuresWhatIsAskedAndWritesAPage) {
    const nlohmann::json result =
        json("bench techniques generated:2 --technique ambient,probes --width 16 --height 12 "
             "--spp 8 --runs 1 --json -o " +
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
