// SPDX-License-Identifier: MIT
// Journeys of a user who lights scenes.
#include "engine/files/project_file.h"
#include "tests/core/source_path.h"
#include "tests/journeys/journey.h"

#include <chrono>
#include <cmath>
#include <variant>

#include <fmt/format.h>

namespace limn {
namespace {

struct LightJourney : Journey {
    /// Adds a light of the Add menu where the picture is clicked, as a share of its size.
    void addAt(const std::string& kind, glm::vec2 share) {
        run(kind);
        clickAt(picture().origin + share * picture().size);
        settle(10);
    }
};

TEST_F(LightJourney, ASceneWithoutLightsSaysSoAndIsLitByOneClick) {
    const std::string scene = sourcePath("../shared/scenes/godot-room/room.glb");
    if (lacks(scene))
        return;
    startScreen();
    if (!screen)
        return;
    startEditor(scene);
    ASSERT_TRUE(sees("Nothing lights this scene.", 120));
    settle(20);
    shot("1-hint");
    click("Add sun and sky");
    waitForLight();
    EXPECT_TRUE(seesNoMore("Nothing lights this scene.", 5));
    shot("2-lit");
}

TEST_F(LightJourney, AnEmptySponzaIsLitToAFinishedLookAndSaved) {
    const std::string scene = sourcePath("../shared/scenes/sponza-crytek/Sponza.gltf");
    if (lacks(scene))
        return;
    startScreen(1280, 960);
    if (!screen)
        return;
    startEditor(scene);
    ASSERT_TRUE(sees("Nothing lights this scene.", 200));
    settle(30);
    shot("1-empty");
    click("Add sun and sky");
    waitForLight(500);
    shot("2-sun-and-sky");
    setField("Elevation (°)", {"68"});
    setField("Azimuth (°)", {"20"});
    setField("Strength (lux)", {"12"});
    waitForLight();
    shot("3-sun-turned");
    const struct {
        glm::vec2 at;
        std::vector<std::string> color;
    } lamps[] = {{{0.2f, 0.7f}, {"1", "0.25", "0.1"}},
                 {{0.4f, 0.75f}, {"0.2", "0.5", "1"}},
                 {{0.65f, 0.75f}, {"0.3", "1", "0.4"}},
                 {{0.85f, 0.7f}, {"1", "0.2", "0.7"}}};
    for (const auto& lamp : lamps) {
        addAt("Point light", lamp.at);
        setField("Colour", lamp.color);
        setField("Strength (cd)", {"8"});
    }
    waitForLight();
    shot("4-four-lamps");
    addAt("Rectangle light", {0.5f, 0.3f});
    setField("Size (m)", {"2", "1"});
    setField("Radiance (nits)", {"6"});
    waitForLight();
    shot("5-area-light");
    screen->key("ctrl+s");
    ASSERT_TRUE(sees("Save as", 20));
    const std::string saved = (scratch / "finished.limn").string();
    enterPath(saved);
    ASSERT_TRUE(waitFor([](const auto& s) { return s["unsaved"] == false; }, 60));
    settle();
    shot("6-saved");
    quit();
    const auto project = loadProject(saved);
    ASSERT_TRUE(project);
    std::size_t lights = 0;
    for (const auto& [id, object] : project->document.objects)
        lights += std::holds_alternative<Light>(object);
    EXPECT_EQ(lights, 6U);
}

TEST_F(LightJourney, TheCornerOfCornellIsExplainedByClicks) {
    startScreen();
    if (!screen)
        return;
    startEditor(draftCornell());
    waitForLight();
    showTab("Explain");
    clickAt(picture().origin + glm::vec2(0.723f, 0.86f) * picture().size); // the floor at the wall
    ASSERT_TRUE(sees("Red, green, blue", 60));
    settle(30);
    shot("1-by-origin");
    click("By sender");
    EXPECT_TRUE(sees("Right wall (Green)", 30));
    settle(20);
    shot("2-by-sender");
}

TEST_F(LightJourney, TwoTechniquesAreComparedBySwitching) {
    startScreen();
    if (!screen)
        return;
    startEditor(draftCornell());
    waitForLight();
    shot("1-illuminance");
    select("Technique");
    choose("Technique", "Ambient");
    settle(30);
    shot("2-ambient");
    screen->key("ctrl+z");
    EXPECT_TRUE(sees("Bake up to date", 60)) << "the bake is kept";
    settle(30);
    shot("3-illuminance-again");
}

/// What a bake takes and how far its picture is from the reference.
struct Outcome {
    double bytes = 0, nrmse = 0, noise = 0;
};

/// Waits for a bake of another size than `before` and for what its light is measured to be.
std::optional<Outcome> outcome(Journey& journey, double before) {
    using Clock = std::chrono::steady_clock;
    constexpr std::uint32_t kSamples = 32; // fewer say little
    constexpr std::chrono::seconds kQuiet(10);
    std::uint64_t number = 0; // of the newest comparison
    Clock::time_point since;
    const bool measured = journey.waitFor(
        [&](const nlohmann::json& s) {
            if (s["bake_bytes"] == before || !s["bake_up_to_date"] || !s["relight_converged"] ||
                s["comparison"].is_null() || s["comparison"]["samples"] < kSamples)
                return false;
            // A picture that was drawn before the light had converged may still be compared.
            if (const std::uint64_t newest = s["comparison"]["number"]; newest != number) {
                number = newest;
                since = Clock::now();
            }
            return Clock::now() - since > kQuiet;
        },
        600);
    if (!measured)
        return {};
    const nlohmann::json now = journey.statistics();
    return Outcome{now["bake_bytes"], now["comparison"]["nrmse"], now["comparison"]["nrmse_noise"]};
}

// Two ways to half of the memory are tried, and the better one is kept.
TEST_F(LightJourney, MemoryIsHalvedAtTheLeastError) {
    startScreen(1024, 768);
    if (!screen)
        return;
    startEditor(draftCornell());
    waitForLight();
    select("Bake settings");
    rest();
    run("Irradiance");
    screen->key("shift+r");
    const auto whole = outcome(*this, 0);
    ASSERT_TRUE(whole);
    shot("1-whole");
    setField("Links (n_L)", {"16"});
    const auto links = outcome(*this, whole->bytes);
    ASSERT_TRUE(links);
    shot("2-fewer-links");
    screen->key("ctrl+z");
    ASSERT_TRUE(waitFor([&](const auto& s) { return s["bake_bytes"] == whole->bytes; }))
        << "the first bake again";
    setField("Lightmap texels", {"2800"});
    const auto texels = outcome(*this, whole->bytes);
    ASSERT_TRUE(texels);
    shot("3-fewer-texels");
    for (const Outcome* o : {&*whole, &*links, &*texels})
        fmt::print("{:.1f} MiB, nRMSE {:.3f} \u00b1 {:.3f}\n", o->bytes / (1 << 20), o->nrmse,
                   o->noise);
    EXPECT_LE(links->bytes, whole->bytes / 2);
    EXPECT_LE(texels->bytes, whole->bytes / 2);
    EXPECT_GT(std::abs(links->nrmse - texels->nrmse), links->noise + texels->noise)
        << "one of the two is better";
    if (links->nrmse < texels->nrmse) {
        screen->key("ctrl+z");
        setField("Links (n_L)", {"16"});
        ASSERT_TRUE(outcome(*this, texels->bytes));
    }
    settle(5);
    shot("4-kept");
    EXPECT_LE(statistics()["bake_bytes"], whole->bytes / 2);
}

TEST_F(LightJourney, PlacesGetTheLightTheyAreToHave) {
    startScreen();
    if (!screen)
        return;
    startEditor(draftCornell());
    waitForLight();
    addAt("Point light", {0.35f, 0.6f});
    waitForLight();
    addAt("Point light", {0.65f, 0.4f});
    waitForLight();
    showTab("Lights");
    ASSERT_TRUE(sees("Click a surface in the picture, then add a goal for its light"));
    shot("1-no-goals");
    for (const glm::vec2 share : {glm::vec2(0.4f, 0.85f), {0.6f, 0.85f}}) {
        clickAt(picture().origin + share * picture().size);
        settle(20);
        click("Add goal");
    }
    rest();
    settle(5);
    shot("2-goals");
    click("Solve");
    rest();
    ASSERT_TRUE(seesNoMore("Working", 60));
    waitForLight();
    settle(10);
    shot("3-solved");
}

} // namespace
} // namespace limn
