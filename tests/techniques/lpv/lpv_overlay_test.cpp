// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/lpv_overlay.h"

#include "engine/techniques/lpv/arrival.h"
#include "engine/techniques/lpv/blockers.h"
#include "engine/techniques/lpv/lpv.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

namespace limn::lpv_overlay_test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// A cube of 4 m seen from inside, of albedo 1/2, with a lamp of 1 cd in its middle.
Scene litCube() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(0), glm::vec3(4), true));
    b.scene.lights = {{.kind = LightKind::Point, .position = glm::vec3(2), .strength = 1}};
    b.scene.technique = {"lpv", {{"lpv.resolution", 8}}};
    return b.build();
}

std::shared_ptr<const LightSnapshot> snapshotOf(const Scene& scene) {
    const TraceScene trace(scene);
    const auto lighting = kLpvTechnique.light({});
    EXPECT_FALSE(lighting->snapshot()) << "nothing is lit yet";
    lighting->update({.scene = scene, .trace = &trace}, {});
    return lighting->snapshot();
}

const OverlayKind& kindNamed(const std::string& name) {
    for (const OverlayKind& kind : kLpvOverlays)
        if (kind.name == name)
            return kind;
    ADD_FAILURE() << name;
    return kLpvOverlays[0];
}

/// The number that follows `before` in a text.
double numberAfter(const std::string& text, const std::string& before) {
    const std::size_t at = text.find(before);
    EXPECT_NE(at, std::string::npos) << text;
    return std::strtod(text.c_str() + at + before.size(), nullptr);
}

Lobe cosine(glm::vec3 n, float flux) {
    const float k = flux / kPi;
    return {glm::vec3(k * kCosineMean), glm::vec3(k * kCosineSlope * n.y),
            glm::vec3(k * kCosineSlope * n.z), glm::vec3(k * kCosineSlope * n.x)};
}

TEST(LpvOverlay, ALobeHasTheFluxOfItsClampedCosine) {
    EXPECT_NEAR(fluxOf(cosine({0, 1, 0}, 3)).x, 3, 1e-5);
}

// The harmonics of a clamped cosine of 1 are 1/4 + 1/2 along its axis and -1/4 against it.
TEST(LpvOverlay, AWallBlocksThreeQuartersStraightThroughIt) {
    const Scene scene = litCube();
    const Lattice lattice = latticeOver(scene.bounds, 8);
    const FaceBlockers blockers = blockersOf(surfacePieces(scene, lattice.cell / 2), lattice);
    for (int axis = 0; axis < 3; ++axis)
        for (const int end : {0, 8}) {
            glm::ivec3 wall(4), air(4);
            wall[axis] = end;
            air[axis] = 3;
            EXPECT_NEAR(blockedShare(blockers, axis, wall), 0.75f, 0.01f) << axis;
            EXPECT_NEAR(blockedShare(blockers, axis, air), 0, 1e-6f) << axis;
        }
    const OverlayData data =
        snapshotOf(scene)->overlay({.kind = &kindNamed("lpv-blockers")}, scene, nullptr);
    for (const OverlayMark& mark : data.marks) {
        EXPECT_EQ(mark.shape, MarkShape::Square);
        EXPECT_NEAR(mark.radius, 0.4f * lattice.cell, 1e-5f);
    }
    // Six walls of 8 x 8 faces, seen from either side; those across them are left out.
    EXPECT_EQ(data.marks.size(), 2U * 6 * 64);
}

TEST(LpvOverlay, WhatIsInjectedIsTheFluxThatTheRoomReflects) {
    const Scene scene = litCube();
    const OverlayData data =
        snapshotOf(scene)->overlay({.kind = &kindNamed("lpv-injected")}, scene, nullptr);
    EXPECT_NEAR(numberAfter(data.legend.notes[1], "average; "), 0.5 * 4 * kPi, 0.01 * 2 * kPi);
    // Only the cells at the walls are lit: 8^3 - 6^3 of 8^3.
    EXPECT_EQ(numberAfter(data.legend.notes[0], " of "), 512 - 216);
}

TEST(LpvOverlay, TexelsLieOnTheWallsAndFaceTheLamp) {
    Scene scene = litCube();
    const OverlayData data =
        snapshotOf(scene)->overlay({.kind = &kindNamed("lpv-texels")}, scene, nullptr);
    ASSERT_EQ(data.marks.size(), kShownTexels);
    for (const OverlayMark& mark : data.marks) {
        const glm::vec3 off = glm::abs(mark.position - glm::vec3(2));
        EXPECT_NEAR(std::max({off.x, off.y, off.z}), 2, 1e-4f);
        EXPECT_GT(glm::dot(mark.normal, glm::vec3(2) - mark.position), 1.9f);
    }
    scene.lights.clear();
    EXPECT_TRUE(snapshotOf(scene)
                    ->overlay({.kind = &kindNamed("lpv-texels")}, scene, nullptr)
                    .marks.empty());
}

/// Number of rings.
std::size_t ringsOf(const OverlayData& data) {
    return std::size_t(std::ranges::count(data.marks, MarkShape::Ring, &OverlayMark::shape));
}

// Both sides of a wall that lies aslant through a cell inject into that cell. Those of one along
// its faces, and walls that face each other across a cell, do not light through anything.
TEST(LpvOverlay, CellsThatBothSidesOfAWallLightHaveRings) {
    const OverlayKind& texels = kindNamed("lpv-texels");
    Scene scene = litCube();
    EXPECT_EQ(ringsOf(snapshotOf(scene)->overlay({.kind = &texels}, scene, nullptr)), 0U);
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(0), glm::vec3(4), true));
    // From corner to corner, thinner than a thousandth of a cell.
    const glm::vec3 off(2e-4f, 0, -2e-4f);
    const glm::vec3 along(4, 0, 4), up(0, 4, 0);
    b.add(simple::quad(off, up, along));
    b.add(simple::quad(-off, along, up));
    b.scene.technique = scene.technique;
    for (const glm::vec3 at : {glm::vec3(3, 2, 1), glm::vec3(1, 2, 3)})
        b.scene.lights.push_back({.kind = LightKind::Point, .position = at, .strength = 1});
    const Scene parted = b.build();
    const OverlayData data = snapshotOf(parted)->overlay({.kind = &texels}, parted, nullptr);
    EXPECT_GT(ringsOf(data), 8U);
    for (const OverlayMark& mark : data.marks)
        if (mark.shape == MarkShape::Ring) {
            EXPECT_LT(std::abs(mark.position.x - mark.position.z), 0.6f) << "away from the wall";
        }
    EXPECT_NE(data.legend.entries.back().text.find(std::to_string(ringsOf(data)) + " cells"),
              std::string::npos);
}

TEST(LpvOverlay, LightArrivesACellLaterEachRound) {
    CellLight injected({8, 1, 1});
    injected.add({0, 0, 0}, {glm::vec3(1), glm::vec3(0), glm::vec3(0), glm::vec3(0)});
    const std::vector<std::uint32_t> arrival = arrivalRounds(injected, nullptr, 5);
    EXPECT_EQ(arrival, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, kNeverLit, kNeverLit}));
    EXPECT_EQ(arrivalRounds(CellLight({2, 1, 1}), nullptr, 3),
              (std::vector<std::uint32_t>{kNeverLit, kNeverLit}));
}

TEST(LpvOverlay, ArrivalIsDrawnOnTheWallsAndDarkWhereTooFewRoundsLead) {
    Scene scene = litCube();
    // A spot lights the floor's corner alone.
    scene.lights = {
        {.kind = LightKind::Spot, .position = {0.4f, 1, 0.4f}, .strength = 1, .outerAngle = 0.3f}};
    scene.technique.settings["lpv.rounds"] = 4;
    const auto shown = [&] {
        return snapshotOf(scene)->overlay({.kind = &kindNamed("lpv-arrival")}, scene, nullptr);
    };
    const OverlayData few = shown();
    EXPECT_EQ(few.marks.size(), 6U * 64) << "one for each cell before six walls";
    const auto dark = [](const OverlayData& data) {
        const std::uint32_t color = data.legend.entries.back().color;
        return std::ranges::count(data.marks, color, &OverlayMark::color);
    };
    EXPECT_GT(dark(few), 100);
    for (const OverlayMark& mark : few.marks) { // the wall behind the face
        const glm::vec3 off = glm::abs(mark.position - glm::vec3(2));
        EXPECT_NEAR(std::max({off.x, off.y, off.z}), 2, 0.02f);
        EXPECT_GT(glm::dot(mark.normal, glm::vec3(2) - mark.position), 1.9f);
    }
    scene.technique.settings["lpv.rounds"] = 40;
    EXPECT_EQ(dark(shown()), 0);
}

TEST(LpvOverlay, NegativePartsOfALobeAreMagentaAndDarkCellsAreLeftOut) {
    LitLattice lit{
        {.size = glm::uvec3(2, 1, 1)}, CellLight({2, 1, 1}), {}, FaceBlockers({2, 1, 1}), {}, 0, 0};
    lit.sum = {cosine({0, 1, 0}, 1), Lobe{}};
    const LpvSnapshot snapshot(std::move(lit));
    const OverlayData data = snapshot.overlay({.kind = &kindNamed("lpv-lobes")}, Scene{}, nullptr);
    ASSERT_FALSE(data.marks.empty());
    std::size_t negative = 0;
    for (const OverlayMark& mark : data.marks) {
        EXPECT_LT(mark.position.x, 1.1f) << "the second cell is dark";
        const bool magenta = (mark.color >> 8 & 255) == 0 && (mark.color & 255) > 0;
        negative += magenta ? 1 : 0;
        EXPECT_TRUE(!magenta || mark.position.y < 0.5f) << "the cosine is negative below";
    }
    // 1/4 + cos/2 is negative below cos = -1/2, which is a quarter of the sphere.
    EXPECT_NEAR(double(negative) / double(data.marks.size()), 0.25, 0.02);
}

TEST(LpvOverlay, AClickPicksTheCellInFrontOfTheSurfaceWhichIsDescribed) {
    const Scene scene = litCube();
    const auto snapshot = snapshotOf(scene);
    Hit hit;
    hit.position = {2.1f, 4, 0.6f};
    hit.geometricNormal = {0, -1, 0};
    hit.instance = 0;
    const auto cell = snapshot->pickAt(scene, hit);
    ASSERT_TRUE(cell);
    const Lattice lattice = latticeOver(scene.bounds, 8);
    EXPECT_EQ(lattice.place(*cell), glm::uvec3(4, 7, 1));
    hit.position = {2.1f, 2.1f, 0.6f};
    hit.geometricNormal = {0, 1, 0};
    hit.frontFace = false; // the back of a sheet lights what is below it
    EXPECT_EQ(lattice.place(*snapshot->pickAt(scene, hit)).y, 3U);
    const auto lines = snapshot->describePick(scene, *cell);
    EXPECT_EQ(lines[0].text, "Cell 4, 7, 1 of 8 x 8 x 8");
    EXPECT_EQ(lines[1].text, "At 2.25, 3.75, 0.75 m");
    EXPECT_GT(numberAfter(lines[3].text, "Injected "), 0);
    EXPECT_GE(numberAfter(lines[2].text, "Flux "), numberAfter(lines[3].text, "Injected "));
    EXPECT_EQ(lines[8].text, "-Y 0 %, +Y 75 %");
    Scene finer = scene;
    finer.technique.settings["lpv.resolution"] = 16;
    const auto other = snapshotOf(finer);
    const auto same = other->nearestPick(*snapshot, *cell);
    ASSERT_TRUE(same);
    EXPECT_EQ(latticeOver(scene.bounds, 16).place(*same) / 2U, glm::uvec3(4, 7, 1));
}

} // namespace
} // namespace limn::lpv_overlay_test
