// SPDX-License-Identifier: MIT
// Meshes nobody models on purpose, from bake to lit caches: done with finite, bounded light, or
// refused in words.
#include "engine/math/packing.h"
#include "engine/math/sh.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::hostile_mesh_test {
namespace {

using namespace simple;

constexpr double kPi = std::numbers::pi;

bool finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void expectSound(const Bake& bake) {
    const Surfels& s = bake.surfels;
    for (std::size_t i = 0; i < s.size(); ++i) {
        ASSERT_TRUE(finite(s.position[i])) << "surfel " << i;
        ASSERT_NEAR(glm::length(s.normal[i]), 1, 1e-3) << "surfel " << i;
        ASSERT_TRUE(s.area[i] > 0 && std::isfinite(s.area[i])) << "surfel " << i;
    }
    for (const float w : bake.tree.leftWeight)
        ASSERT_TRUE(w >= 0 && w <= 1);
    const Caches& c = bake.caches;
    for (std::size_t i = 0; i < c.size(); ++i)
        ASSERT_TRUE(finite(c.position[i]) && finite(c.normal[i])) << "cache " << i;
    for (const Link& link : c.links) {
        ASSERT_LT(link.node, bake.tree.size());
        const float u = halfToFloat(link.u), transport = halfToFloat(link.transport);
        ASSERT_TRUE(u >= 0 && u <= 2);
        ASSERT_TRUE(transport >= 0 && std::isfinite(transport));
    }
    for (const float w : c.fillWeight)
        ASSERT_TRUE(w >= 0 && w <= 1);
}

struct Lit {
    double mean = 0, least = 0, most = 0; ///< irradiance of the surface caches [W m^-2]
};

/// Bakes, checks and lights a scene by what its materials and sky send.
Lit bakedAndLit(Scene scene, std::uint32_t bounces) {
    scene.bake.surfels = 2000;
    scene.bake.rays = 128;
    scene.bake.links = 64;
    scene.bake.lightmapCaches = 1000;
    const TraceScene trace(scene);
    Result<Bake> made = bake(trace);
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    if (!made)
        return {};
    expectSound(*made);
    Relighter relighter(std::make_shared<const Bake>(std::move(*made)));
    relighter.relight(scene, trace, bounces);
    const Caches& caches = relighter.bake().caches;
    const int bands = int(scene.bake.bands);
    const std::vector<glm::vec3>& sh = relighter.cacheSh();
    for (const glm::vec3& c : sh)
        EXPECT_TRUE(finite(c));
    Lit lit{0, 1e30, -1e30};
    std::size_t count = 0;
    for (std::uint32_t c = 0; c < caches.lightmapCount; ++c) {
        if (caches.linkBegin[c] == caches.linkBegin[c + 1])
            continue;
        const double E = double(
            shIrradiance(bands, &sh[std::size_t(c) * std::size_t(bands * bands)], caches.normal[c])
                .y);
        lit.mean += E;
        lit.least = std::min(lit.least, E);
        lit.most = std::max(lit.most, E);
        ++count;
    }
    EXPECT_GT(count, 0U);
    lit.mean /= double(std::max<std::size_t>(count, 1));
    return lit;
}

/// Under an even sky of radiance 1, whatever stands where, no point gets more than pi, and none
/// less than nothing.
void expectWithinASky(const Lit& lit) {
    EXPECT_LE(lit.most, kPi * 1.02);
    EXPECT_GE(lit.least, -0.02 * kPi);
    EXPECT_GT(lit.mean, 0);
}

Scene underSky(SceneBuilder& b) {
    Scene scene = b.build();
    scene.sky.radiance = glm::vec3(1);
    return scene;
}

Mesh triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    Mesh m = flatShaded({a, b, c}, 0);
    for (glm::vec3& n : m.normals)
        n = finite(n) ? n : glm::vec3(0, 1, 0); // as the importer mends them
    return m;
}

/// Triangles of all sizes, among them needles, duplicates and ones without area.
Mesh soup(std::size_t count) {
    std::mt19937 rng(8);
    std::uniform_real_distribution<float> unit(0, 1);
    const auto point = [&] { return glm::vec3(unit(rng), unit(rng), unit(rng)); };
    Mesh m;
    m.material = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 o = point() * 10.f;
        const float size = std::pow(10.f, -3 * unit(rng));
        glm::vec3 corners[3] = {o, o + point() * size, o + point() * size};
        if (i % 10 == 1)
            corners[2] = corners[1] + point() * size * 1e-5f;
        if (i % 10 == 2)
            corners[2] = corners[1];
        if (i % 10 == 3 && i > 3)
            std::copy_n(m.positions.end() - 9, 3, corners);
        const glm::vec3 n = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        for (const glm::vec3 p : corners) {
            m.indices.push_back(std::uint32_t(m.positions.size()));
            m.positions.push_back(p);
            m.normals.push_back(glm::length(n) > 0 ? glm::normalize(n) : glm::vec3(0, 1, 0));
        }
    }
    return m;
}

TEST(HostileMesh, OneTriangleUnderTheSkyGetsPi) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(triangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}));
    const Lit lit = bakedAndLit(underSky(b), 4);
    expectWithinASky(lit);
    EXPECT_NEAR(lit.mean, kPi, 0.02 * kPi);
}

TEST(HostileMesh, TrianglesWithoutAreaAreRefusedInWords) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(triangle(glm::vec3(1), glm::vec3(1), glm::vec3(1)));
    b.add(triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2}));
    const Result<Bake> refused = bake(TraceScene(b.build()));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("nothing to bake"), std::string::npos)
        << refused.error().message;
}

TEST(HostileMesh, ASoupOf100000TrianglesIsLitWithinBounds) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.8f)));
    b.add(soup(100000));
    expectWithinASky(bakedAndLit(underSky(b), 6));
}

Lit litAtScale(float scale) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    const glm::mat4 s = glm::scale(glm::mat4(1), glm::vec3(scale));
    b.add(quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0}), s);
    b.add(box(glm::vec3(1, 0.1f, 1), glm::vec3(2, 1.5f, 2), false), s);
    return bakedAndLit(underSky(b), 6);
}

TEST(HostileMesh, ScaleChangesNoLight) {
    const Lit metres = litAtScale(1);
    expectWithinASky(metres);
    for (const float scale : {1e-3f, 1e4f}) {
        const Lit scaled = litAtScale(scale);
        expectWithinASky(scaled);
        EXPECT_NEAR(scaled.mean, metres.mean, 1e-3 * metres.mean) << "scale " << scale;
    }
}

TEST(HostileMesh, CoplanarDoubleWallsAreLitWithinBounds) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.8f)));
    Material both = lambert(glm::vec3(0.8f));
    both.doubleSided = true;
    b.addMaterial(both);
    b.add(quad({0, 0, 0}, {0, 0, 3}, {3, 0, 0}));
    b.add(quad({1, 0, 0}, {0, 2, 0}, {0, 0, 3})); // a wall, back to back with itself
    b.add(quad({1, 0, 0}, {0, 0, 3}, {0, 2, 0}));
    b.add(quad({2, 0, 0}, {0, 2, 0}, {0, 0, 3}, 1)); // a two-sided one twice over
    b.add(quad({2, 0, 0}, {0, 2, 0}, {0, 0, 3}, 1));
    b.add(quad({0, 0, 0}, {0, 0, 3}, {3, 0, 0})); // and the floor
    expectWithinASky(bakedAndLit(underSky(b), 6));
}

/// B = rho E + pi L_e, and E <= greatest B: so E <= pi L_e / (1 - rho), which all reach where
/// everything emits.
TEST(HostileMesh, AClosedBoxInAClosedBoxKeepsItsEnergyBetweenTheWalls) {
    for (const bool all : {false, true}) {
        SceneBuilder b;
        b.addMaterial(lambert(glm::vec3(0.5f), glm::vec3(1)));
        b.addMaterial(lambert(glm::vec3(0.5f), all ? glm::vec3(1) : glm::vec3(0)));
        b.add(box(glm::vec3(0), glm::vec3(4), true, 1));
        b.add(box(glm::vec3(1), glm::vec3(2.5f), false, 0));
        b.add(box(glm::vec3(1.2f), glm::vec3(2.3f), true, 1)); // inside the inner one's walls
        b.add(box(glm::vec3(1.5f), glm::vec3(1.9f), false, 1));
        const Lit lit = bakedAndLit(b.build(), 20);
        EXPECT_LE(lit.most, kPi / 0.5 * 1.02);
        EXPECT_GE(lit.least, -0.02 * kPi / 0.5);
        if (all)
            EXPECT_NEAR(lit.mean, kPi / 0.5, 0.01 * kPi / 0.5);
        else
            EXPECT_LT(lit.least, 0.02) << "the innermost room is dark";
    }
}

} // namespace
} // namespace limn::hostile_mesh_test
