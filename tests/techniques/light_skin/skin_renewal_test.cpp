// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/draw_renewal.h"

#include "engine/lighting/lighting_driver.h"
#include "tests/techniques/light_skin/lit_by_skin.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

#include <glm/geometric.hpp>

namespace limn::skin_renewal_test {
namespace {

/// A room with a block that moves and a lamp.
Scene room(double renew) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false), glm::mat4(1), true);
    b.scene.lights = {{.kind = LightKind::Point, .position = {3, 2.5f, 1.5f}, .strength = 10}};
    b.scene.technique.settings = {{"light-skin.map_size", 24}, {"light-skin.vals", 200},
                                  {"light-skin.samples", 48},  {"light-skin.spacing", 6},
                                  {"light-skin.glossy", 0},    {"light-skin.renew", renew}};
    return b.build();
}

/// The view of frame k, whose camera moves and turns.
Viewpoint viewOf(int k) {
    Viewpoint view{
        .camera = {.eye = {3.5f, 1.5f, 4.5f}, .target = {1, 1, 1}}, .aspect = 1, .size = {64, 64}};
    view.camera.eye.x -= 0.03f * float(k);
    view.camera.target.z += 0.05f * float(k);
    return view;
}

std::vector<glm::vec3> fluxesOf(const LitBySkin& lit) {
    return lit.part().light().flux;
}

DrawKey keyOf(float renew) {
    DrawKey key{.columns = 6, .rows = 4, .sources = 1, .settings = {}, .ofView = true};
    key.settings.renew = renew;
    return key;
}

TEST(SkinRenewal, PartsTakeTurnsAfterAllWereDrawnOnce) {
    DrawRenewal renewal;
    EXPECT_FALSE(renewal.isDue());
    renewal.begin(keyOf(1.f / 3));
    const DrawBlock first = renewal.next();
    EXPECT_EQ(first.blocks, 1U) << "all of them";
    EXPECT_FALSE(renewal.isDue());
    std::vector<std::uint32_t> blocks;
    for (int change = 0; change < 2; ++change) { // the second one before the first has ended
        renewal.begin(keyOf(1.f / 3));
        for (int k = 0; k < (change == 0 ? 2 : 3); ++k) {
            ASSERT_TRUE(renewal.isDue());
            const DrawBlock block = renewal.next();
            EXPECT_EQ(block.blocks, 3U);
            blocks.push_back(block.block);
        }
    }
    EXPECT_FALSE(renewal.isDue());
    EXPECT_EQ(blocks, (std::vector<std::uint32_t>{0, 1, 2, 0, 1}));
    for (DrawKey other : {keyOf(0.5f), keyOf(1.f / 3), keyOf(1.f / 3)}) {
        other.columns += other.settings.renew < 0.4f ? 1 : 0;
        renewal.begin(other);
        other.sources = 2;
        renewal.begin(other);
        EXPECT_EQ(renewal.next().blocks, 1U) << "other settings, another raster, another light";
        EXPECT_FALSE(renewal.isDue());
    }
    DrawKey unseen = keyOf(0.25f);
    unseen.ofView = false;
    for (int k = 0; k < 2; ++k) {
        renewal.begin(unseen);
        EXPECT_EQ(renewal.next().blocks, 1U) << "light without a view does not lag";
    }
}

TEST(SkinRenewal, AllPartsAreAllDraws) {
    VirtualLights lights{.columns = 20, .rows = 20};
    std::vector<float> importance;
    for (std::uint32_t cell = 0; cell < 400; cell += 1 + cell % 3) {
        lights.add({float(cell), 0, 0}, {0, 1, 0}, glm::vec3(float(1 + cell % 7)), 1, 0, cell);
        importance.push_back(float(1 + cell % 5));
    }
    const ChoiceOptions options{.count = 101, .defence = 0.3f};
    LightDraws whole, parts;
    drawLights(lights, importance, options, {}, whole);
    // Of another importance, then part by part of this one.
    const std::vector<float> other(importance.rbegin(), importance.rend());
    drawLights(lights, other, options, {}, parts);
    std::size_t same = 0;
    for (std::uint32_t block = 0; block < 4; ++block) {
        EXPECT_NE(parts.weight, whole.weight);
        LightDraws before = parts;
        drawLights(lights, importance, options, {block, 4}, parts);
        std::size_t changed = 0;
        for (std::size_t k = 0; k < 101; ++k)
            changed += parts.cell[k] != before.cell[k] || parts.weight[k] != before.weight[k];
        EXPECT_LE(changed, 27U) << "a quarter, with one more of each kind";
        same += 101 - changed;
    }
    EXPECT_GE(same, 303U);
    EXPECT_EQ(parts.cell, whole.cell);
    EXPECT_EQ(parts.weight, whole.weight);
    EXPECT_EQ(drawnLights(lights, parts).light, chooseLights(lights, importance, options).light);
    // Lights that have moved leave cells empty: their draws count for nothing.
    const std::uint32_t gone = lights.cell[30];
    VirtualLights fewer{.columns = 20, .rows = 20};
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (lights.cell[i] != gone)
            fewer.add(lights.positionOf(i), {0, 1, 0}, lights.fluxOf(i), 1, 0, lights.cell[i]);
    const ChosenLights found = drawnLights(fewer, whole);
    std::set<std::uint32_t> cells, drawn(whole.cell.begin(), whole.cell.end());
    for (const std::uint32_t i : found.light)
        cells.insert(fewer.cell[i]);
    drawn.erase(gone);
    EXPECT_EQ(cells, drawn);
}

/// Lights a sequence in which the view, then the block, then the lamp move.
void moveEverything(LitBySkin& lit) {
    for (int k = 0; k < 3; ++k) {
        const Viewpoint view = viewOf(k);
        lit.update(&view);
    }
    const Viewpoint view = viewOf(3);
    for (int k = 0; k < 3; ++k) {
        lit.scene.instances[1].toWorld[3].z += 0.1f;
        lit.retrace();
        lit.update(&view);
    }
    for (int k = 0; k < 3; ++k) {
        lit.scene.lights[0].position.z += 0.1f;
        lit.update(&view);
    }
}

TEST(SkinRenewal, AtRestIsTheLightOfAllDrawsWithTheSameBits) {
    LitBySkin whole(room(1)), lazy(room(0.25)), again(room(0.25));
    moveEverything(whole);
    moveEverything(lazy);
    moveEverything(again);
    EXPECT_NE(fluxesOf(lazy), fluxesOf(whole));
    EXPECT_EQ(fluxesOf(lazy), fluxesOf(again)) << "the same sequence";
    const Viewpoint view = viewOf(3);
    for (int k = 2; k <= 4; ++k) { // the lamp's last move was the first of four updates
        EXPECT_NE(fluxesOf(lazy), fluxesOf(whole));
        const LightingReport report = lazy.update(&view);
        EXPECT_FALSE(report.skipped);
        EXPECT_EQ(counterOf(report, "lights_traced"), 0);
        EXPECT_EQ(report.converged, k == 4) << k;
        EXPECT_EQ(report.bounces, k == 4 ? 1U : 0U) << k;
    }
    EXPECT_EQ(fluxesOf(lazy), fluxesOf(whole));
    EXPECT_TRUE(lazy.update(&view).skipped);
    // A jump without a view leaves nothing behind.
    for (LitBySkin* lit : {&whole, &lazy}) {
        lit->scene.lights[0].position.x = 1;
        EXPECT_TRUE(lit->update().converged);
    }
    EXPECT_EQ(fluxesOf(lazy), fluxesOf(whole));
}

TEST(SkinRenewal, TheDriverGoesOnUntilAllDrawsAreRenewed) {
    LitBySkin lit(room(0.25));
    LightingDriver driver(std::move(lit.lighting));
    const auto updates = [&](const Viewpoint& view) {
        int count = 0;
        driver.viewIs(view);
        for (; !driver.done(); ++count)
            driver.step({.scene = lit.scene, .trace = lit.trace.get(), .view = &view},
                        LightingDriver::Rest::All);
        return count;
    };
    EXPECT_EQ(updates(viewOf(0)), 1) << "the first light is whole";
    EXPECT_EQ(updates(viewOf(1)), 4);
    lit.scene.relight.maxBounces = 1;
    EXPECT_EQ(updates(viewOf(2)), 4);
}

TEST(SkinRenewal, FlickersLessWhileTheViewMoves) {
    const auto change = [](double renew) {
        LitBySkin lit(room(renew));
        std::vector<double> before;
        double squares = 0;
        for (int k = 0; k < 20; ++k) {
            const Viewpoint view = viewOf(k);
            lit.update(&view);
            std::vector<double> now;
            for (const glm::vec3 p : {glm::vec3(3, 0, 3), {0.4f, 0, 3}, {2.5f, 0, 0.7f}})
                now.push_back(double(lit.irradiance(p, {0, 1, 0}).x));
            for (std::size_t i = 0; i < before.size(); ++i)
                squares += std::pow(now[i] / before[i] - 1, 2);
            before = now;
        }
        return std::sqrt(squares / 57);
    };
    const double all = change(1), tenth = change(0.1);
    std::printf("change between frames: %.3f %%; renewing a tenth, %.3f %%\n", 100 * all,
                100 * tenth);
    EXPECT_LT(tenth, 0.75 * all);
    EXPECT_GT(tenth, 0);
}

// Kept draws read what the map shows now: they follow a moved lamp within their noise.
TEST(SkinRenewal, LightOfKeptDrawsIsThatOfThePresentMap) {
    LitBySkin lazy(room(0.02)), all(room(1));
    all.scene.technique.settings["light-skin.all"] = 1;
    const Viewpoint view = viewOf(0);
    const auto meanOf = [](const LitBySkin& lit) {
        double sum = 0;
        for (float z = 0.5f; z < 5; z += 0.5f)
            sum += double(lit.irradiance({2.4f, 3, z}, {0, -1, 0}).x);
        return sum;
    };
    double before = 0;
    for (int k = 0; k < 6; ++k) {
        for (LitBySkin* lit : {&lazy, &all}) {
            lit->scene.lights[0].position.z += k == 0 ? 0 : 0.15f;
            lit->scene.lights[0].position.y -= k == 0 ? 0 : 0.25f;
            lit->update(&view);
        }
        if (k == 0)
            before = meanOf(all);
    }
    std::printf("moved: %.4f, all texels %.4f, before %.4f\n", meanOf(lazy), meanOf(all), before);
    EXPECT_GT(std::abs(before / meanOf(all) - 1), 0.2);
    EXPECT_NEAR(meanOf(lazy) / meanOf(all), 1, 0.1);
}

} // namespace
} // namespace limn::skin_renewal_test
