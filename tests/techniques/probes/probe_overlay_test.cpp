// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/probe_overlay.h"

#include "engine/overlay/palette.h"
#include "engine/techniques/probes/probes.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace limn::probe_overlay_test {
namespace {

const std::uint32_t kSolid = packColor({1, 0, 1}), kStale = packColor({0.9f, 0.45f, 0});

/// A room of 4 m with a solid block of 1.3 m in one corner and a lamp.
Scene room() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(0), glm::vec3(4), true));
    b.add(simple::box(glm::vec3(0), glm::vec3(1.3f), false));
    b.scene.lights = {{.kind = LightKind::Point, .position = {3, 3, 3}, .strength = 10}};
    b.scene.technique = {"probes", {{"probes.count", 64}, {"probes.side", 16}}};
    return b.build();
}

struct Lit {
    explicit Lit(Scene s = room()) : scene(std::move(s)) {}

    Scene scene;
    TraceScene trace{scene};
    std::unique_ptr<Lighting> lighting = kProbesTechnique.light({});

    LightingReport update(const Viewpoint* view = nullptr) {
        return lighting->update({.scene = scene, .trace = &trace, .view = view}, {});
    }
    OverlayData overlay(std::size_t kind, std::uint32_t pick = ~0U) const {
        return lighting->snapshot()->overlay({.kind = &kProbeOverlays[kind], .pick = pick}, scene,
                                             nullptr);
    }
};

std::uint32_t count(const OverlayData& data, MarkShape shape, std::uint32_t color) {
    return std::uint32_t(std::ranges::count_if(data.marks, [&](const OverlayMark& mark) {
        return mark.shape == shape && mark.color == color;
    }));
}

TEST(ProbeOverlay, ProbesInSolidsAreSquaresThatShowAndTheOthersBalls) {
    Lit lit;
    EXPECT_FALSE(lit.lighting->snapshot()) << "nothing is lit yet";
    const LightingReport report = lit.update();
    const OverlayData data = lit.overlay(0);
    const auto solid = std::uint32_t(counterOf(report, "probes_in_solids"));
    ASSERT_GT(solid, 0U);
    const std::uint32_t squares = count(data, MarkShape::Square, kSolid);
    const auto balls = std::uint32_t(counterOf(report, "probes")) - solid;
    EXPECT_EQ((data.marks.size() - squares) % balls, 0U);
    EXPECT_GE(data.marks.size(), squares + 48U * balls);
    // Each where it stands, and at least on the block's three sides that are in the room.
    EXPECT_GE(squares, 4 * solid);
    EXPECT_LE(squares, 7 * solid);
    for (const OverlayMark& mark : data.marks)
        if (mark.shape == MarkShape::Square && mark.normal != glm::vec3(0)) {
            const float along = glm::dot(mark.position, glm::abs(mark.normal));
            EXPECT_TRUE(std::abs(along - 1.3f) < 0.1f || std::abs(along) < 0.1f) << along;
        }
}

TEST(ProbeOverlay, ABallIsBrightWhereLightComesFrom) {
    Lit lit;
    // What is below the lamp is a bright floor; all else of the room is black.
    lit.scene.lights[0] = {.kind = LightKind::Spot, .position = {2.5f, 3, 2.5f}, .strength = 100};
    lit.update();
    const OverlayData data = lit.overlay(0);
    // A probe in the middle, above the spot's floor.
    const OverlayMark* lowest = nullptr;
    const OverlayMark* highest = nullptr;
    const OverlayMark* aside = nullptr;
    for (const OverlayMark& mark : data.marks) {
        if (glm::distance(mark.position, glm::vec3(2.5f, 2.5f, 2.5f)) > 0.2f ||
            mark.shape == MarkShape::Square)
            continue;
        if (!lowest || mark.position.y < lowest->position.y)
            lowest = &mark;
        if (!highest || mark.position.y > highest->position.y)
            highest = &mark;
        if (!aside || mark.position.x > aside->position.x)
            aside = &mark;
    }
    ASSERT_TRUE(lowest && highest && aside);
    const auto green = [](const OverlayMark* mark) { return mark->color >> 8 & 255; };
    EXPECT_GT(green(lowest), green(highest)) << "the floor is bright; three bands ring above";
    EXPECT_GT(green(lowest), green(aside) + 50);
}

TEST(ProbeOverlay, RaysEndOnTheSurfacesThatTheProbeSees) {
    Lit lit;
    lit.update();
    const auto snapshot = lit.lighting->snapshot();
    Hit hit;
    hit.position = {4, 2.1f, 3.9f};
    hit.geometricNormal = {-1, 0, 0};
    const auto probe = snapshot->pickAt(lit.scene, hit);
    ASSERT_TRUE(probe);
    EXPECT_EQ(*probe, 3U + 4 * (2 + 4 * 3)) << "the nearest of 4 x 4 x 4";
    const OverlayData data = lit.overlay(1, *probe);
    const glm::vec3 from(3.5f, 2.5f, 3.5f);
    EXPECT_EQ(data.marks[0].position, from);
    float farthest = 0;
    for (const OverlayMark& mark : data.marks) {
        farthest = std::max(farthest, glm::distance(from, mark.position));
        for (int a = 0; a < 3; ++a)
            EXPECT_TRUE(mark.position[a] > -1e-3f && mark.position[a] < 4.001f);
    }
    EXPECT_GT(farthest, 4) << "the far corner is 5.5 m away, less the mark's own size";
    EXPECT_EQ(count(data, MarkShape::Disc, packColor({1, 0, 1})), 0U) << "it sees no backs";
    const OverlayData inSolid = lit.overlay(1, 0);
    EXPECT_GT(count(inSolid, MarkShape::Disc, packColor({1, 0, 1})), 16U * 16 / 4);
    EXPECT_TRUE(lit.overlay(1).marks.empty()) << "none is picked";
    EXPECT_EQ(snapshot->describePick(lit.scene, 0)[0].text, "Probe 0, in a solid");
    const auto lines = snapshot->describePick(lit.scene, *probe);
    EXPECT_EQ(lines[1].text, "At 3.5, 2.5, 3.5 m");
    EXPECT_EQ(lines[6].text, "100.0 %  fronts");
    EXPECT_EQ(*snapshot->nearestPick(*snapshot, *probe), *probe);
}

TEST(ProbeOverlay, ProbesThatWaitForTheirTurnAreStale) {
    Lit lit;
    lit.update();
    EXPECT_EQ(count(lit.overlay(2), MarkShape::Square, kStale), 0U);
    lit.scene.lights[0].position.x -= 0.5f;
    lit.scene.technique.settings["probes.perUpdate"] = 5;
    const Viewpoint view{};
    for (const std::uint32_t stale : {59U, 54U}) {
        const LightingReport report = lit.update(&view);
        EXPECT_EQ(counterOf(report, "probes_stale"), stale);
        const OverlayData data = lit.overlay(2);
        EXPECT_EQ(count(data, MarkShape::Square, kStale), stale);
        EXPECT_EQ(data.marks.size(), 64U);
        EXPECT_EQ(count(data, MarkShape::Disc, data.legend.entries[0].color), 5U)
            << "lit by the last update";
    }
    lit.update();
    EXPECT_EQ(count(lit.overlay(2), MarkShape::Square, kStale), 0U);
}

TEST(ProbeOverlay, WeightsCoverTheSurfacesThatAProbeLights) {
    Lit lit;
    lit.update();
    const std::uint32_t corner = 63; // the last of 4 x 4 x 4, at (3.5, 3.5, 3.5)
    const OverlayData data = lit.overlay(3, corner);
    const OverlayMark* nearest = nullptr;
    for (const OverlayMark& mark : data.marks) {
        if (mark.shape == MarkShape::Ring)
            continue;
        for (int a = 0; a < 3; ++a)
            EXPECT_GT(mark.position[a], 2.3f) << "cells that look it up end 1 m before it";
        if (!nearest || glm::distance(mark.position, glm::vec3(4)) <
                            glm::distance(nearest->position, glm::vec3(4)))
            nearest = &mark;
    }
    ASSERT_TRUE(nearest);
    EXPECT_EQ(nearest->color, packColor(viridis(1))) << "beyond the outermost, it lights alone";
    EXPECT_EQ(lit.overlay(3, 0).legend.notes[0], "It stands in a solid and is not used");
    EXPECT_TRUE(lit.overlay(3).marks.empty()) << "none is picked";
}

TEST(ProbeOverlay, WhatAWallHidesFromAProbeIsDark) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(0), glm::vec3(4), true));
    b.add(simple::box({1.9f, -0.1f, -0.1f}, {2.1f, 4.1f, 4.1f}, false)); // between two layers
    b.scene.technique = {"probes", {{"probes.count", 64}, {"probes.side", 16}}};
    Lit lit(b.build());
    lit.update();
    const OverlayData data = lit.overlay(4, 1 + 4 * (1 + 4 * 1)); // at (1.5, 1.5, 1.5)
    int here = 0, hereSeen = 0, beyond = 0, beyondSeen = 0;
    const auto isSeen = [](const OverlayMark& m) { return (m.color >> 8 & 255) > 120; }; // v > 1/2
    // The far side of the wall itself is too near to what hides it to be told apart.
    for (const OverlayMark& mark : data.marks)
        if (mark.shape != MarkShape::Ring && std::abs(mark.position.x - 2.1f) > 0.05f) {
            (mark.position.x < 2 ? here : beyond) += 1;
            (mark.position.x < 2 ? hereSeen : beyondSeen) += isSeen(mark) ? 1 : 0;
        }
    ASSERT_GT(here, 100);
    ASSERT_GT(beyond, 100);
    EXPECT_GT(hereSeen, 0.8 * here);
    EXPECT_LT(beyondSeen, 0.1 * beyond);
}

TEST(ProbeOverlay, NearlyAllReflectionsInAConvexRoomMeetASurface) {
    Scene convex = room();
    convex.instances.resize(1); // without the block
    Lit lit(std::move(convex));
    lit.update();
    const OverlayData data = lit.overlay(5, 21);
    constexpr std::array kShapes = {MarkShape::Disc, MarkShape::Disc, MarkShape::Square};
    unsigned total = 0, said[3] = {};
    for (std::size_t k = 0; k < 3; ++k) { // "disc: 250 meet a surface"
        const std::string& text = data.legend.entries[k].text;
        said[k] = unsigned(std::stoi(text.substr(text.find(' '))));
        total += said[k];
        if (k == 2) { // the paths are of discs, too
            EXPECT_EQ(count(data, kShapes[k], data.legend.entries[k].color), said[k]) << text;
        }
    }
    EXPECT_EQ(total, 16U * 16);
    EXPECT_GT(said[0], 0.95 * total);
}

} // namespace
} // namespace limn::probe_overlay_test
