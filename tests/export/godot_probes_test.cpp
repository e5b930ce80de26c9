// SPDX-License-Identifier: MIT
#include "engine/export/godot_probes.h"

#include "engine/export/grid_texture.h"
#include "tests/export/known_light.h"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::godot_probes_test {
namespace {

std::array<glm::vec3, 9> linearLight(glm::vec3 p) {
    std::array<glm::vec3, 9> c{};
    c[0] = p + glm::vec3(10);
    return c;
}

double volume(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 d) {
    return glm::dot(glm::cross(b - a, c - a), d - a) / 6;
}

/// The tetrahedron that Godot finds at `p`.
std::size_t tetrahedronAt(const GodotProbes& probes, glm::vec3 p) {
    std::int32_t node = 0;
    while (node >= 0) {
        const GodotProbes::Node& n = probes.nodes.at(std::size_t(node));
        const bool over = n.plane[0] * p.x + n.plane[1] * p.y + n.plane[2] * p.z - n.plane[3] > 0;
        node = over ? n.over : n.under;
    }
    return std::size_t(-node - 1);
}

/// Weights of a tetrahedron's points.
std::array<double, 4> barycentrics(const GodotProbes& probes, std::size_t tetrahedron,
                                   glm::dvec3 p) {
    std::array<glm::dvec3, 4> v;
    for (std::size_t k = 0; k < 4; ++k)
        v[k] = probes.points.at(probes.tetrahedra.at(tetrahedron)[k]);
    const double whole = volume(v[0], v[1], v[2], v[3]);
    return {volume(p, v[1], v[2], v[3]) / whole, volume(v[0], p, v[2], v[3]) / whole,
            volume(v[0], v[1], p, v[3]) / whole, volume(v[0], v[1], v[2], p) / whole};
}

} // namespace

TEST(GodotProbes, EveryPositionLiesInTheTetrahedronThatTheTreeFinds) {
    const KnownLight light(linearLight, {4, 3, 5});
    const GodotProbes probes = godotProbes(light.field, {100, 0, -7});
    EXPECT_EQ(probes.points.size(), 60U);
    EXPECT_EQ(probes.tetrahedra.size(), 5U * 3 * 2 * 4);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0.001f, 0.999f);
    for (int k = 0; k < 2000; ++k) {
        const glm::vec3 p = probes.lower + glm::vec3(unit(random), unit(random), unit(random)) *
                                               (probes.upper - probes.lower);
        const std::size_t t = tetrahedronAt(probes, p);
        const auto weights = barycentrics(probes, t, p);
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_GT(weights[i], -1e-4);
            sum += weights[i] * glm::dvec3(probes.harmonics[probes.tetrahedra[t][i]][0]);
        }
        const glm::dvec3 expected =
            (glm::dvec3(p) - glm::dvec3(100, 0, -7) + 10.0) / std::numbers::pi;
        EXPECT_LT(glm::length(sum - expected), 1e-3); // linear light is interpolated exactly
    }
}

TEST(GodotProbes, TetrahedraFillTheBox) {
    const KnownLight light(linearLight, {3, 4, 2});
    const GodotProbes probes = godotProbes(light.field, glm::vec3(0));
    double sum = 0;
    for (const auto& t : probes.tetrahedra)
        sum += std::abs(volume(probes.points[t[0]], probes.points[t[1]], probes.points[t[2]],
                               probes.points[t[3]]));
    const glm::dvec3 size(probes.upper - probes.lower);
    EXPECT_NEAR(sum, size.x * size.y * size.z, 1e-6 * sum);
}

TEST(GodotProbes, AnAxisOfOneCellHasProbesAtItsBorders) {
    const KnownLight light(linearLight, {1, 2, 1});
    const GodotProbes probes = godotProbes(light.field, glm::vec3(0));
    EXPECT_EQ(probes.points.size(), 8U);
    EXPECT_EQ(probes.lower.x, light.field.gridBounds.lower.x);
    EXPECT_EQ(probes.upper.x, light.field.gridBounds.upper.x);
}

TEST(GodotProbes, ALargeGridIsThinnedAndKeepsItsOuterCells) {
    const KnownLight light(linearLight, {64, 32, 48});
    const GodotProbes probes = godotProbes(light.field, glm::vec3(0));
    EXPECT_LE(probes.points.size(), kMaxGodotProbes);
    EXPECT_GT(probes.points.size(), kMaxGodotProbes / 8);
    EXPECT_NEAR(probes.lower.x, -4 + 4.f / 64, 1e-6f);
    EXPECT_NEAR(probes.upper.z, 8 - 8.f / 48, 1e-6f);
    for (std::size_t i = 0; i < probes.points.size(); ++i)
        EXPECT_LT(glm::length(probes.harmonics[i][0] * std::numbers::pi_v<float> -
                              probes.points[i] - 10.f),
                  1e-4f);
}

} // namespace limn::godot_probes_test
