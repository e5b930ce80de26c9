// SPDX-License-Identifier: MIT
#include "engine/scene/mesh/shape_mesh.h"

#include "engine/scene/mesh/triangle_geometry.h"

#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::shape_mesh_test {
namespace {

constexpr double kPi = std::numbers::pi;

double areaOf(const Mesh& mesh) {
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
        area += triangleArea(mesh, t);
    return area;
}

/// By the divergence theorem: a sixth of the triple products of all triangles.
double volumeOf(const Mesh& mesh) {
    double six = 0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const auto [a, b, c] = mesh.triangle(t);
        six +=
            double(glm::dot(mesh.positions[a], glm::cross(mesh.positions[b], mesh.positions[c])));
    }
    return six / 6;
}

TEST(ShapeMesh, AreasAndVolumesAreThoseOfTheShapes) {
    EXPECT_NEAR(areaOf(shapeMesh(Shape::Plane)), 1, 1e-6);
    EXPECT_NEAR(areaOf(shapeMesh(Shape::Box)), 6, 1e-5);
    // 48 sides fall short of a circle by 0.3 % in area, and of a sphere's by less than 1 %.
    EXPECT_NEAR(areaOf(shapeMesh(Shape::Sphere)), kPi, 0.01 * kPi);
    EXPECT_NEAR(areaOf(shapeMesh(Shape::Cylinder)), 1.5 * kPi, 0.005 * kPi);
    EXPECT_NEAR(volumeOf(shapeMesh(Shape::Box)), 1, 1e-5);
    EXPECT_NEAR(volumeOf(shapeMesh(Shape::Sphere)), kPi / 6, 0.01 * kPi / 6);
    EXPECT_NEAR(volumeOf(shapeMesh(Shape::Cylinder)), kPi / 4, 0.005 * kPi / 4);
}

TEST(ShapeMesh, ShapesStandOnThePlaneAndAreAMetreWide) {
    for (const Shape shape : kShapes) {
        const Mesh mesh = shapeMesh(shape);
        glm::vec3 lower(1e9f), upper(-1e9f);
        for (const glm::vec3 p : mesh.positions) {
            lower = glm::min(lower, p);
            upper = glm::max(upper, p);
        }
        const float height = shape == Shape::Plane ? 0.f : 1.f;
        EXPECT_LT(glm::distance(lower, {-0.5f, 0, -0.5f}), 1e-6f) << shapeName(shape);
        EXPECT_LT(glm::distance(upper, {0.5f, height, 0.5f}), 1e-6f) << shapeName(shape);
    }
}

TEST(ShapeMesh, MeshesKeepWhatImportersGuarantee) {
    for (const Shape shape : kShapes) {
        const Mesh mesh = shapeMesh(shape);
        ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
        ASSERT_EQ(mesh.uv0.size(), mesh.positions.size());
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            EXPECT_NEAR(glm::length(mesh.normals[v]), 1, 1e-5f);
            EXPECT_EQ(glm::clamp(mesh.uv0[v], 0.f, 1.f), mesh.uv0[v]);
        }
        for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
            const auto [a, b, c] = mesh.triangle(t);
            EXPECT_GT(triangleArea(mesh, t), 0) << shapeName(shape) << ' ' << t;
            const glm::vec3 face = triangleNormal(mesh, std::uint32_t(t));
            for (const std::uint32_t v : {a, b, c}) // faces and normals point the same way
                EXPECT_GT(glm::dot(face, mesh.normals[v]), 0.9f) << shapeName(shape) << ' ' << t;
        }
    }
}

TEST(ShapeMesh, PathsNameShapes) {
    EXPECT_EQ(shapePath(Shape::Cylinder), "shape:cylinder");
    for (const Shape shape : kShapes)
        EXPECT_EQ(shapeOfPath(shapePath(shape)), shape);
    EXPECT_FALSE(shapeOfPath("box"));
    EXPECT_FALSE(shapeOfPath("shape:Box"));
    EXPECT_FALSE(shapeOfPath(""));
}

} // namespace
} // namespace limn::shape_mesh_test
