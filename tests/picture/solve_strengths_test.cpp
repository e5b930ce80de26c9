// SPDX-License-Identifier: MIT
#include "engine/picture/solve_strengths.h"

#include "engine/files/project_file.h"
#include "engine/math/luminance.h"
#include "engine/techniques/technique_table.h"
#include "tests/core/source_path.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>

namespace limn::solve_strengths_test {
namespace {

/// The Cornell box under two lamps of its own, one of which is coloured, with few surfels.
Scene twoLamps() {
    const ImportedScene project =
        std::move(*loadProject(sourcePath("projects/cornell/cornell.limn")));
    Scene scene = flatten(project.document, project.assets);
    scene.bake.surfels = 1500;
    scene.bake.lightmapCaches = 1500;
    scene.bake.rays = 64;
    scene.bake.links = 32;
    const glm::vec3 centre = scene.bounds.centre(), size = scene.bounds.size();
    for (const float side : {-1.f, 1.f}) {
        Light lamp;
        lamp.kind = LightKind::Point;
        lamp.position = centre + 0.3f * size * glm::vec3(side, 0.6f, 0.5f);
        lamp.color = side < 0 ? glm::vec3(1) : glm::vec3(1, 0.5f, 0.2f);
        lamp.strength = 2;
        scene.lights.push_back(lamp);
    }
    return scene;
}

ConvergedLight light(const Scene& unlit) {
    const auto scene = std::make_shared<const Scene>(unlit);
    const auto trace = std::make_shared<const TraceScene>(*scene);
    const Technique& technique = *findTechnique(scene->technique.technique);
    Prepared prepared = {*technique.precomputation->prepare(*trace, {}, {}), scene};
    return std::move(*convergeLight(scene, trace, technique, prepared, LitFor::Pictures, {}));
}

PixelQuestion pixel(const Scene& scene, std::uint32_t x, std::uint32_t y,
                    PixelLight of = PixelLight::Irradiance) {
    return {.camera = chooseCamera(scene, {}),
            .width = 40,
            .height = 30,
            .x = x,
            .y = y,
            .light = of,
            .samples = 4};
}

double luminanceAt(const ConvergedLight& lit, const PixelQuestion& question) {
    return luminance(glm::dvec3(explainPixel(lit, question).total));
}

Result<SolvedStrengths> solve(const ConvergedLight& now, std::span<const StrengthGoal> goals,
                              std::span<const std::uint32_t> lights,
                              const Progress& progress = {}) {
    return solveStrengths(now, *findTechnique(now.scene->technique.technique), goals, lights,
                          progress);
}

std::vector<std::uint32_t> lamps(const Scene& scene) {
    const auto count = std::uint32_t(scene.lights.size());
    return {count - 2, count - 1};
}

TEST(SolveStrengths, FindsTheStrengthsThatMadeTheGoals) {
    Scene wanted = twoLamps();
    wanted.lights[wanted.lights.size() - 2].strength = 0.3f;
    wanted.lights.back().strength = 9;
    const ConvergedLight then = light(wanted);
    for (const PixelLight of : {PixelLight::Irradiance, PixelLight::Radiance}) {
        std::vector<StrengthGoal> goals;
        for (const std::array<std::uint32_t, 2> p : {std::array{8U, 20U}, {31U, 20U}, {20U, 26U}})
            goals.push_back({pixel(wanted, p[0], p[1], of), 0});
        for (StrengthGoal& goal : goals)
            goal.luminance = luminanceAt(then, goal.question);
        const ConvergedLight now = light(twoLamps());
        const auto solved = solve(now, goals, lamps(wanted));
        ASSERT_TRUE(solved) << solved.error().message;
        const std::size_t first = wanted.lights.size() - 2;
        EXPECT_NEAR(solved->factor[first], 0.15, 0.15 * 0.02);
        EXPECT_NEAR(solved->factor[first + 1], 4.5, 4.5 * 0.005);
        for (std::size_t l = 0; l < first; ++l)
            EXPECT_EQ(solved->factor[l], 1);
        for (std::size_t g = 0; g < goals.size(); ++g) {
            EXPECT_NEAR(solved->goals[g].after, goals[g].luminance, 5e-3 * goals[g].luminance);
            EXPECT_NEAR(solved->goals[g].before, luminanceAt(now, goals[g].question), 1e-9);
        }
    }
}

TEST(SolveStrengths, WhatItSaysIsWhatTheSceneThenHas) {
    Scene scene = twoLamps();
    const ConvergedLight now = light(scene);
    const StrengthGoal goal = {pixel(scene, 20, 26), 3 * luminanceAt(now, pixel(scene, 20, 26))};
    const auto solved = solve(now, std::array{goal}, lamps(scene));
    ASSERT_TRUE(solved) << solved.error().message;
    for (std::size_t l = 0; l < scene.lights.size(); ++l)
        scene.lights[l].strength *= float(solved->factor[l]);
    EXPECT_NEAR(luminanceAt(light(scene), goal.question), goal.luminance, 5e-3 * goal.luminance);
    // One goal, two lamps: both change by as little as can be.
    EXPECT_GT(solved->factor[scene.lights.size() - 2], 1);
    EXPECT_GT(solved->factor.back(), 1);
}

TEST(SolveStrengths, AsksAgainWhereGatheredLightIsNotLinear) {
    Scene scene = twoLamps();
    const ConvergedLight now = light(scene);
    PixelQuestion question = pixel(scene, 20, 26);
    question.samples = 16;
    question.gatherRays = 16;
    const StrengthGoal goal = {question, 200 * luminanceAt(now, question)};
    const auto solved = solve(now, std::array{goal}, lamps(scene));
    ASSERT_TRUE(solved) << solved.error().message;
    for (std::size_t l = 0; l < scene.lights.size(); ++l)
        scene.lights[l].strength *= float(solved->factor[l]);
    const double there = luminanceAt(light(scene), question);
    EXPECT_NEAR(there, goal.luminance, 5e-3 * goal.luminance);
    EXPECT_NEAR(there, solved->goals[0].after, 1e-4 * there);
}

TEST(SolveStrengths, NeverAsksForNegativeLight) {
    const Scene scene = twoLamps();
    const ConvergedLight now = light(scene);
    const PixelQuestion question = pixel(scene, 20, 26);
    const StrengthGoal darker = {question, 1e-6 * luminanceAt(now, question)};
    const auto solved = solve(now, std::array{darker}, lamps(scene));
    ASSERT_TRUE(solved) << solved.error().message;
    EXPECT_EQ(solved->factor.back(), 0);
    EXPECT_EQ(solved->factor[scene.lights.size() - 2], 0);
    EXPECT_GT(solved->goals[0].after, darker.luminance) << "the box's own lamp stays";
    EXPECT_LT(solved->goals[0].after, solved->goals[0].before);
}

TEST(SolveStrengths, SaysWhyItFails) {
    Scene scene = twoLamps();
    scene.lights.back().enabled = false;
    const ConvergedLight now = light(scene);
    const std::array goals = {StrengthGoal{pixel(scene, 20, 26), 1}};
    const std::array off = {std::uint32_t(scene.lights.size() - 1)};
    const auto unreached = solve(now, goals, off);
    ASSERT_FALSE(unreached);
    EXPECT_EQ(unreached.error().message, "none of the lights that may change reaches a goal");
    const std::atomic<bool> cancel = true;
    const auto cancelled = solve(now, goals, lamps(scene), {.cancel = &cancel});
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().message, "cancelled");
}

} // namespace
} // namespace limn::solve_strengths_test
