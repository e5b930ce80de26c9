// SPDX-License-Identifier: MIT
#include "engine/measure/fit_to_budget.h"

#include "engine/techniques/technique_table.h"
#include "tests/techniques/illuminance/relight/lit_room.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>

namespace limn::fit_to_budget_test {
namespace {

const Technique& kFitted = precomputingTechnique({});

const SettingsSweep kSmallSweep = {{"surfels", {"64", "128", "256"}},
                                   {"links", {"4", "8", "32"}},
                                   {"lightmapCaches", {"50", "100", "400"}}};
const SettingsSweep kSmallestSweep = {
    {"surfels", {"64", "256"}}, {"links", {"4", "32"}}, {"lightmapCaches", {"50", "400"}}};
constexpr double kUnlimited = 1e9; // seconds, where the outcome must not depend on the machine

Result<FittedSettings> fit(const Scene& scene, const SearchGoal& limits, double seconds = 20,
                           const Progress& progress = {},
                           const SettingsSweep& sweep = kSmallSweep) {
    return fitToBudget(kFitted, TraceScene(scene), sweep,
                       {limits, chooseCamera(scene, {}), seconds}, progress);
}

/// Memory of the bake with the least settings of the sweep.
double leastBytes(const Scene& scene) {
    const Result<FittedSettings> fitted = fit(scene, {.maxBytes = 1});
    return fitted ? fitted->best.bytes : 0;
}

TEST(FitToBudget, KeepsTheBudgetAndMeasuresNothingTwice) {
    const Scene scene = *litRoom(100, 60);
    const double least = leastBytes(scene);
    ASSERT_GT(least, 0);
    double before = std::numeric_limits<double>::infinity();
    for (const double factor : {1.5, 3., 10.}) {
        const SearchGoal limits{.maxBytes = factor * least};
        const Result<FittedSettings> fitted = fit(scene, limits);
        ASSERT_TRUE(fitted) << fitted.error().message;
        EXPECT_TRUE(fitted->kept);
        EXPECT_EQ(shortfall(*fitted, limits), "");
        EXPECT_LE(fitted->best.bytes, limits.maxBytes);
        EXPECT_EQ(fitted->best.level, 2);
        EXPECT_EQ(fitted->settings, 27U);
        for (std::size_t i = 0; i < fitted->trials.size(); ++i) {
            const SettingsTrial& trial = fitted->trials[i];
            for (std::size_t k = 0; k < i; ++k)
                EXPECT_FALSE(trial.settings == fitted->trials[k].settings &&
                             trial.level == fitted->trials[k].level);
            if (trial.level == 2 && trial.bytes <= limits.maxBytes) {
                EXPECT_LE(fitted->best.nrmse, trial.nrmse);
            }
        }
        EXPECT_LE(fitted->best.nrmse, before) << "more memory, less error";
        before = fitted->best.nrmse;
    }
}

TEST(FitToBudget, FindsTheLeastTimeForAnError) {
    const Scene scene = *litRoom(100, 60);
    const auto fitted = [&](const SearchGoal& limits) {
        return fit(scene, limits, kUnlimited, {}, kSmallestSweep);
    };
    const Result<FittedSettings> any = fitted({.maxError = 10});
    ASSERT_TRUE(any && any->kept);
    const SearchGoal limits{.maxError = 0.5 * any->best.nrmse};
    const Result<FittedSettings> half = fitted(limits);
    ASSERT_TRUE(half) << half.error().message;
    EXPECT_TRUE(half->kept);
    EXPECT_LE(half->best.nrmse, *limits.maxError);
    const BakeSettings &cheap = any->best.settings, &fine = half->best.settings;
    EXPECT_GT(std::uint64_t(fine.links) * fine.lightmapCaches * fine.surfels,
              std::uint64_t(cheap.links) * cheap.lightmapCaches * cheap.surfels);
}

TEST(FitToBudget, SaysWhatNothingKeeps) {
    const Scene scene = *litRoom(100, 60);
    const SearchGoal limits{.maxMs = 1e-6, .maxBytes = 1024};
    const Result<FittedSettings> fitted = fit(scene, limits);
    ASSERT_TRUE(fitted) << fitted.error().message;
    EXPECT_FALSE(fitted->kept);
    const std::string why = shortfall(*fitted, limits);
    EXPECT_NE(why.find("ms, not 1e-06"), std::string::npos) << why;
    EXPECT_NE(why.find("MiB, not 0.000976562"), std::string::npos) << why;
}

TEST(FitToBudget, MeasuresAtEachLevelWhateverTheTime) {
    const Scene scene = *litRoom(100, 60);
    const Result<FittedSettings> fitted = fit(scene, {.maxMs = 1000}, 1e-3);
    ASSERT_TRUE(fitted) << fitted.error().message;
    EXPECT_TRUE(fitted->kept);
    EXPECT_EQ(fitted->best.level, 2);
    EXPECT_LE(fitted->trials.size(), 4U);
}

TEST(FitToBudget, FailsInTheDarkAndWhenCancelled) {
    Scene scene = *litRoom(100, 60);
    const std::atomic<bool> cancel = true;
    const Result<FittedSettings> cancelled = fit(scene, {.maxMs = 1}, 60, {.cancel = &cancel});
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().message, "cancelled");
    scene.lights.clear();
    for (Material& m : scene.materials)
        m = simple::lambert(glm::vec3(0.05f)); // paths of few bounces
    scene.sky = {};
    const Result<FittedSettings> dark = fit(scene, {.maxMs = 1});
    ASSERT_FALSE(dark);
    EXPECT_EQ(dark.error().message, "the camera sees no light, so no error is known");
}

} // namespace
} // namespace limn::fit_to_budget_test
