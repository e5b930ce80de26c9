// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/photon_overlay.h"

#include "tests/techniques/photon_lattices/lit_by_photons.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace limn::photon_overlay_test {
namespace {

Scene room() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.8f, 0.4f, 0.2f}));
    b.addMaterial(mirror({0.9f, 0.7f, 0.4f}));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false, 1));
    b.scene.lights = {{.name = "Lamp", .kind = LightKind::Point, .position = {3, 2, 3}}};
    return b.build();
}

struct Shown {
    LitByPhotons lit{room(), {{"photons", 5000}}};
    std::shared_ptr<const LightSnapshot> snapshot;

    Shown() {
        lit.update();
        snapshot = lit.lighting->snapshot();
    }
    OverlayData overlay(std::size_t kind, std::uint32_t pick = ~0U) const {
        return snapshot->overlay({.kind = &kPhotonOverlays[kind], .pick = pick}, lit.scene,
                                 snapshot.get());
    }
};

TEST(PhotonOverlay, DrawsThePathOfThePickedPhotonFromItsLight) {
    const Shown shown;
    ASSERT_GT(shown.snapshot->pickCount(), 1000U);
    const Hit hit = shown.lit.trace->closestHit({glm::vec3(3.5f, 1, 4), {0, -1, 0}});
    const auto pick = shown.snapshot->pickAt(shown.lit.scene, hit);
    ASSERT_TRUE(pick);
    const auto& snapshot = static_cast<const PhotonSnapshot&>(*shown.snapshot);
    const Photon& photon = *snapshot.stored(*pick).photon;
    EXPECT_LT(glm::distance(photon.position, hit.position), 0.5f);
    EXPECT_GT(photon.normal.y, 0.9f);
    const OverlayData data = shown.overlay(1, *pick);
    const auto touches = [&](glm::vec3 p) {
        return std::ranges::any_of(data.marks, [&](const OverlayMark& mark) {
            return glm::distance(mark.position, p) < 1e-5f;
        });
    };
    EXPECT_TRUE(touches(photon.position));
    EXPECT_TRUE(touches(glm::vec3(3, 2, 3))) << "the lamp";
    const auto lines = shown.snapshot->describePick(shown.lit.scene, *pick);
    EXPECT_EQ(lines.back().text, "Sent by Lamp");
    EXPECT_EQ(shown.snapshot->nearestPick(*shown.snapshot, *pick), pick);
}

// A light that lights diffuse walls alone stores in the middle lattice, and by mirrors in the fine
// one.
TEST(PhotonOverlay, ColoursPhotonsByTheirLattice) {
    const Shown shown;
    const OverlayData data = shown.overlay(4);
    std::size_t green = 0, blue = 0;
    for (const OverlayMark& mark : data.marks) {
        green += (mark.color >> 8 & 0xff) > 200 ? 1 : 0;
        blue += (mark.color >> 16 & 0xff) > 200 ? 1 : 0;
    }
    EXPECT_GT(green, data.marks.size() / 2);
    EXPECT_GT(blue, 0U);
    EXPECT_EQ(data.marks.size(), std::min(shown.snapshot->pickCount(), 8192U));
}

TEST(PhotonOverlay, CountsThePhotonsOfEachCell) {
    const Shown shown;
    const OverlayData counts = shown.overlay(3);
    const Lattice& mid = shown.lit.part(PhotonLattice::Mid).cells().lattice;
    const auto ofMid = std::ranges::count_if(
        counts.marks, [&](const OverlayMark& mark) { return mark.radius == 0.2f * mid.cell; });
    // Walls of 7 x 5 x 8 cells, all of which the lamp lights.
    EXPECT_GT(ofMid, 100);
    EXPECT_LE(ofMid, std::ptrdiff_t(mid.cells()));
    EXPECT_FALSE(shown.overlay(2).marks.empty());
    const OverlayData areas = shown.overlay(5);
    EXPECT_NE(areas.legend.notes[0].find("cells have less than 5 %"), std::string::npos);
}

} // namespace
} // namespace limn::photon_overlay_test
