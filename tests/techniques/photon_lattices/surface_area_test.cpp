// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/surface_area.h"

#include "engine/techniques/photon_lattices/clip_to_cells.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace limn::surface_area_test {
namespace {

/// Area of all sides by the first harmonic, 2 pi sqrt(1 / 4 pi) = sqrt(pi) per square metre.
double areaOf(const std::vector<CellArea>& cells) {
    double sum = 0;
    for (const CellArea& cell : cells)
        sum += double(cell.harmonics[0]);
    return sum / std::sqrt(std::numbers::pi);
}

TEST(ClipToCells, KeepsTheAreaAndPutsEachPieceIntoItsCell) {
    const Lattice lattice{.lower = glm::vec3(-1, -2, 0.5f), .cell = 0.25f, .size = {9, 12, 7}};
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (int k = 0; k < 200; ++k) {
        std::array<glm::vec3, 3> triangle;
        for (glm::vec3& p : triangle)
            p = lattice.lower + lattice.bounds().size() *
                                    glm::vec3(uniform(random), uniform(random), uniform(random));
        const double area =
            0.5 *
            double(glm::length(glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0])));
        double sum = 0;
        clipToCells(lattice, triangle, [&](std::uint32_t cell, glm::vec3 middle, float piece) {
            sum += double(piece);
            if (piece > 1e-5f) {
                EXPECT_EQ(lattice.index(lattice.at(middle)), cell);
            }
        });
        EXPECT_NEAR(sum, area, 1e-5 * area);
    }
}

// A horizontal unit square over 4 x 4 cells covers each by a sixteenth.
TEST(ClipToCells, DividesASquareEvenly) {
    const Lattice lattice{.lower = glm::vec3(0), .cell = 0.25f, .size = glm::uvec3(4)};
    std::map<std::uint32_t, float> cells;
    for (const float far : {0.f, 1.f})
        clipToCells(lattice, {glm::vec3(0, 0.1f, 0), {1, 0.1f, 1}, {1 - far, 0.1f, far}},
                    [&](std::uint32_t cell, glm::vec3, float area) { cells[cell] += area; });
    EXPECT_EQ(cells.size(), 16U);
    for (const auto& [cell, area] : cells)
        EXPECT_NEAR(area, 1 / 16.f, 1e-6f);
}

// Walls of a room lie in the faces of cells and belong to those within. A sphere that fills the
// lattice touches 56 of 4^3 cells and 272 of 8^3.
TEST(SurfaceAreas, OfAClosedSurfaceAreItsAreaInTheCellsThatItTouches) {
    for (const auto& [side, touched] : {std::pair{4U, 56U}, std::pair{8U, 272U}}) {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.5f)));
        b.add(simple::sphere(2, 5, true));
        const Scene scene = b.build();
        const auto cells = surfaceAreas(scene, 0, latticeOver(scene.bounds, side));
        EXPECT_EQ(cells.size(), touched);
        EXPECT_NEAR(areaOf(cells), simple::areaOf(scene.meshOf(scene.instances[0])), 1e-3);
    }
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(0), glm::vec3(4), true));
    const Scene scene = b.build();
    const auto cells = surfaceAreas(scene, 0, latticeOver(scene.bounds, 4));
    EXPECT_EQ(cells.size(), 56U);
    EXPECT_NEAR(areaOf(cells), 6 * 16, 1e-3);
}

TEST(SurfaceAreas, CountBothSidesOfATwoSidedSurfaceAndNoneThatReflectsNothing) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad(glm::vec3(0), {0, 0, 2}, {2, 0, 0}));
    Scene scene = b.build();
    const Lattice lattice{.lower = glm::vec3(-1), .cell = 1, .size = glm::uvec3(4)};
    const auto area = [&] { return areaOf(surfaceAreas(scene, 0, lattice)); };
    EXPECT_NEAR(area(), 4, 1e-5);
    scene.materials[0].doubleSided = true;
    EXPECT_NEAR(area(), 8, 1e-5);
    scene.materials[0].alphaMode = AlphaMode::Mask;
    scene.materials[0].baseColor.w = 0.1f;
    EXPECT_NEAR(area(), 0, 1e-5) << "one hole";
    scene.materials[0].alphaMode = AlphaMode::Opaque;
    scene.materials[0].metallic = 1;
    EXPECT_NEAR(area(), 0, 1e-5) << "metal";
}

TEST(PhotonAreas, FollowAMovingObjectAsIfTheyWereMadeAnew) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(simple::box(glm::vec3(1), glm::vec3(2), false), glm::mat4(1), true);
    b.add(simple::box(glm::vec3(2.5f), glm::vec3(2.9f), false), glm::mat4(1), true);
    Scene scene = b.build();
    const PhotonLattices lattices = photonLattices(scene.bounds, {.low = 4, .mid = 8, .high = 32});
    PhotonAreas areas;
    EXPECT_TRUE(areas.follow(scene, lattices));
    EXPECT_EQ(areas.clipped(), 3U);
    EXPECT_FALSE(areas.follow(scene, lattices));
    EXPECT_EQ(areas.clipped(), 0U);
    scene.instances[1].toWorld[3].x = 0.7f;
    EXPECT_TRUE(areas.follow(scene, lattices));
    EXPECT_EQ(areas.clipped(), 1U);
    PhotonAreas anew;
    anew.follow(scene, lattices);
    for (std::size_t k = 0; k < kPhotonLattices; ++k) {
        EXPECT_EQ(areas.of(k), anew.of(k));
        EXPECT_NEAR(areaOf(areas.of(k)), 94 + 6 + 6 * 0.16, 2e-3);
    }
    scene.materials[0].baseColor.x = 0.1f;
    EXPECT_FALSE(areas.follow(scene, lattices)) << "a colour has no area";
    scene.instances.pop_back();
    EXPECT_TRUE(areas.follow(scene, lattices));
    EXPECT_EQ(areas.clipped(), 0U);
    EXPECT_NEAR(areaOf(areas.of(0)), 94 + 6, 2e-3);
    scene.instances[1].dynamic = false; // the same places, summed otherwise
    EXPECT_TRUE(areas.follow(scene, lattices));
    EXPECT_NEAR(areaOf(areas.of(0)), 94 + 6, 2e-3);
    scene.instances[1].toWorld[3].x = 1.2f;
    EXPECT_TRUE(areas.follow(scene, lattices));
    EXPECT_EQ(areas.clipped(), 1U) << "one static object of two";
    PhotonAreas again;
    again.follow(scene, lattices);
    for (std::size_t k = 0; k < kPhotonLattices; ++k)
        EXPECT_EQ(areas.of(k), again.of(k));
}

} // namespace
} // namespace limn::surface_area_test
