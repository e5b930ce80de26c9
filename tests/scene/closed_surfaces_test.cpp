// SPDX-License-Identifier: MIT
#include "engine/scene/mesh/closed_surfaces.h"
#include "tests/trace/simple_scene.h"

#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace limn::scene_test {
namespace {

using simple::box;
using simple::sphere;

std::vector<ClosedSurface> surfacesOf(const Mesh& mesh) {
    const Mesh* const meshes[] = {&mesh};
    return findClosedSurfaces(meshes);
}

bool isBehindFront(const Mesh& mesh, const ClosedSurface& surface, glm::dvec3 p) {
    const Mesh* const meshes[] = {&mesh};
    return isBehind(meshes, surface, p);
}

Mesh joined(Mesh mesh, const Mesh& other) {
    const auto first = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
    for (const std::uint32_t i : other.indices)
        mesh.indices.push_back(first + i);
    return mesh;
}

Mesh without(Mesh mesh, std::size_t triangle) {
    mesh.indices.erase(mesh.indices.begin() + std::ptrdiff_t(3 * triangle),
                       mesh.indices.begin() + std::ptrdiff_t(3 * triangle + 3));
    return mesh;
}

Mesh scaled(Mesh mesh, float factor) {
    for (glm::vec3& p : mesh.positions)
        p *= factor;
    return mesh;
}

TEST(ClosedSurfaces, ABoxIsASolid) {
    const Mesh mesh = box(glm::vec3(-1), {1, 2, 3}, false);
    const std::vector<ClosedSurface> found = surfacesOf(mesh);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_FALSE(found[0].isRoom());
    EXPECT_EQ(found[0].shell.size(), 12U);
    EXPECT_DOUBLE_EQ(found[0].volume, 24);
    EXPECT_EQ(found[0].bounds, (Bounds{glm::vec3(-1), {1, 2, 3}}));
    EXPECT_TRUE(isBehindFront(mesh, found[0], {0.9, 1.9, 2.9}));
    EXPECT_FALSE(isBehindFront(mesh, found[0], {0.9, 1.9, 3.1}));
}

TEST(ClosedSurfaces, NeedNoSharedVerticesButEveryTriangle) {
    const Mesh ball = sphere(0.5f, 3, false);
    EXPECT_EQ(surfacesOf(ball).size(), 1U);
    EXPECT_NEAR(surfacesOf(ball)[0].volume, 4 / 3. * 3.14159265 / 8, 0.01);
    for (const std::size_t t : {std::size_t(0), ball.triangleCount() / 2, std::size_t(11)}) {
        EXPECT_TRUE(surfacesOf(without(ball, t)).empty());
        EXPECT_TRUE(surfacesOf(without(box(glm::vec3(0), glm::vec3(1), false), t % 12)).empty());
    }
}

TEST(ClosedSurfaces, ATriangleThatIsTurnedOverOpensAShell) {
    Mesh mesh = box(glm::vec3(0), glm::vec3(1), false);
    std::swap(mesh.indices[4], mesh.indices[5]);
    EXPECT_TRUE(surfacesOf(mesh).empty());
}

TEST(ClosedSurfaces, ARoomHasEverythingElseBehindIt) {
    const Mesh mesh = box(glm::vec3(0), glm::vec3(1), true);
    const std::vector<ClosedSurface> found = surfacesOf(mesh);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_DOUBLE_EQ(found[0].volume, -1);
    EXPECT_TRUE(found[0].isRoom());
    EXPECT_FALSE(isBehindFront(mesh, found[0], {0.1, 0.9, 0.5}));
    EXPECT_TRUE(isBehindFront(mesh, found[0], {0.1, 1.1, 0.5}));
    const Mesh ball = sphere(0.5f, 1, true); // its bounds hold points outside it
    EXPECT_TRUE(isBehindFront(ball, surfacesOf(ball).at(0), glm::dvec3(0.4)));
}

TEST(ClosedSurfaces, WindingNumbersCountShells) {
    const Mesh mesh =
        joined(box(glm::vec3(0), glm::vec3(4), false), box(glm::vec3(1), glm::vec3(2), false));
    std::vector<ShellTriangle> all;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
        all.push_back({0, t});
    const Mesh* const meshes[] = {&mesh};
    EXPECT_NEAR(windingNumber(meshes, all, {1.3, 1.6, 1.2}), 2, 1e-9);
    EXPECT_NEAR(windingNumber(meshes, all, {1.3, 2.6, 1.2}), 1, 1e-9);
    EXPECT_NEAR(windingNumber(meshes, all, {1.3, 4.6, 1.2}), 0, 1e-9);
    // The middle of a face of a cube sees the other five.
    EXPECT_NEAR(windingNumber(meshes, std::span(all).first(12), {2, 2, -1e-9}), 0, 1e-6);
    EXPECT_NEAR(windingNumber(meshes, std::span(all).first(12), {2, 2, 1e-9}), 1, 1e-6);
}

TEST(ClosedSurfaces, ABoxInABoxIsTwo) {
    const Mesh mesh =
        joined(box(glm::vec3(0), glm::vec3(4), false), box(glm::vec3(1), glm::vec3(2), false));
    const std::vector<ClosedSurface> found = surfacesOf(mesh);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_TRUE(isBehindFront(mesh, found[0], glm::dvec3(1.5)));
    EXPECT_TRUE(isBehindFront(mesh, found[1], glm::dvec3(1.5)));
}

TEST(ClosedSurfaces, AHouseHasARoomThatIsNoPartOfItsWalls) {
    const Mesh mesh =
        joined(box(glm::vec3(0), glm::vec3(4), false), box(glm::vec3(1), glm::vec3(3), true));
    const std::vector<ClosedSurface> found = surfacesOf(mesh);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].shell.size(), 24U);
    EXPECT_TRUE(isBehindFront(mesh, found[0], glm::dvec3(0.5)));
    EXPECT_FALSE(isBehindFront(mesh, found[0], glm::dvec3(2.5)));
}

TEST(ClosedSurfaces, ACavityBelongsToTheSmallestSolidAroundIt) {
    Mesh mesh =
        joined(box(glm::vec3(0), glm::vec3(16), false), box(glm::vec3(1), glm::vec3(9), false));
    mesh = joined(mesh, box(glm::vec3(2), glm::vec3(5), true));
    const std::vector<ClosedSurface> found = surfacesOf(mesh);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_TRUE(isBehindFront(mesh, found[0], glm::dvec3(3)));
    EXPECT_FALSE(isBehindFront(mesh, found[1], glm::dvec3(3)));
}

TEST(ClosedSurfaces, SolidsThatCrossOrTouchKeepApart) {
    const Mesh one = box(glm::vec3(0), glm::vec3(2), false);
    for (const glm::vec3 lower : {glm::vec3(1), glm::vec3(2, 0, 0), glm::vec3(2, 2, 0)}) {
        const Mesh mesh = joined(one, box(lower, lower + 2.f, false));
        const std::vector<ClosedSurface> found = surfacesOf(mesh);
        ASSERT_EQ(found.size(), 2U) << lower.x << lower.y << lower.z;
        EXPECT_DOUBLE_EQ(found[0].volume, 8);
        EXPECT_DOUBLE_EQ(found[1].volume, 8);
    }
}

TEST(ClosedSurfaces, FacesOfSeveralMeshesBoundOne) {
    const Mesh whole = box(glm::vec3(0), glm::vec3(1), false);
    std::array<Mesh, 2> part = {whole, whole};
    part[0].indices.resize(12);
    part[1].indices.erase(part[1].indices.begin(), part[1].indices.begin() + 12);
    const Mesh* const meshes[] = {part.data(), &part[1]};
    ASSERT_EQ(findClosedSurfaces(meshes).size(), 1U);
    EXPECT_EQ(findClosedSurfaces(meshes)[0].shell.size(), 12U);
    EXPECT_TRUE(surfacesOf(part[0]).empty());
}

TEST(ClosedSurfaces, ScaleDoesNotMatter) {
    for (const float factor : {0x1p-20f, 0x1p-40f, 0x1p20f, 0x1p40f}) {
        const Mesh mesh = scaled(sphere(0.5f, 2, false), factor);
        const std::vector<ClosedSurface> found = surfacesOf(mesh);
        ASSERT_EQ(found.size(), 1U) << factor;
        EXPECT_TRUE(isBehindFront(mesh, found[0], glm::dvec3(double(factor) * 0.2)));
        EXPECT_FALSE(isBehindFront(mesh, found[0], glm::dvec3(double(factor) * 0.6)));
    }
}

TEST(ClosedSurfaces, TrianglesWithoutAreaChangeNothing) {
    Mesh mesh = box(glm::vec3(0), glm::vec3(1), false);
    mesh.indices.insert(mesh.indices.end(), {0, 0, 1, 2, 2, 2});
    ASSERT_EQ(surfacesOf(mesh).size(), 1U);
    EXPECT_EQ(surfacesOf(mesh)[0].shell.size(), 12U);
}

TEST(ClosedSurfaces, SheetsAndKnotsAreNone) {
    const Mesh front = simple::quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const Mesh back = simple::quad({0, 0, 0}, {0, 1, 0}, {1, 0, 0});
    EXPECT_TRUE(surfacesOf(front).empty());
    EXPECT_TRUE(surfacesOf(joined(front, back)).empty());
    // A tube whose far end is larger than the near one and turned inside out: one shell, half of
    // which has its front inside.
    Mesh knot = box(glm::vec3(-1), glm::vec3(1), false);
    for (glm::vec3& p : knot.positions)
        if (p.z > 0)
            p = {-2 * p.x, 2 * p.y, p.z};
    EXPECT_TRUE(surfacesOf(knot).empty());
    EXPECT_TRUE(surfacesOf(Mesh{}).empty());
    EXPECT_TRUE(findClosedSurfaces({}).empty());
}

TEST(ClosedSurfaces, NumbersThatAreNotFiniteBoundNone) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Mesh mesh = box(glm::vec3(0), glm::vec3(1), false);
        mesh.positions[7].y = bad;
        EXPECT_TRUE(surfacesOf(mesh).empty());
    }
}

} // namespace
} // namespace limn::scene_test
