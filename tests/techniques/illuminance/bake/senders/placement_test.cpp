// SPDX-License-Identifier: MIT
#include "engine/core/parallel.h"
#include "engine/scene/mesh/mesh_topology.h"
#include "engine/techniques/illuminance/bake/senders/relaxation.h"
#include "engine/techniques/illuminance/bake/senders/surface_walk.h"
#include "engine/techniques/illuminance/bake/senders/surfel_owners.h"
#include "engine/techniques/illuminance/bake/senders/surfels.h"
#include "engine/techniques/illuminance/format/surfel_spacing.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace limn::placement_test {
namespace {

using namespace simple;

/// n x n squares of two triangles over [0, 1]^2, lifted by `height`; vertices shared.
template <class Height>
Mesh patch(std::uint32_t n, const Height& height) {
    Mesh m;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) {
            const float x = float(i) / float(n), y = float(j) / float(n);
            m.positions.emplace_back(x, y, height(x, y));
        }
    m.normals.assign(m.positions.size(), glm::vec3(0, 0, 1));
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            m.indices.insert(m.indices.end(), {a, b, c, b, d, c});
        }
    return m;
}

Mesh flatPatch(std::uint32_t n) {
    return patch(n, [](float, float) { return 0.f; });
}

Mesh wavyPatch() {
    return patch(40, [](float x, float y) { return 0.1f * std::sin(9 * x) * std::cos(7 * y); });
}

glm::vec3 at(const Mesh& mesh, const MeshPoint& p) {
    return trianglePoint(mesh, p.triangle, p.barycentric);
}

void expectInside(const MeshPoint& p) {
    EXPECT_GE(p.barycentric.x, 0);
    EXPECT_GE(p.barycentric.y, 0);
    EXPECT_LE(p.barycentric.x + p.barycentric.y, 1);
}

SurfelSpacing spacingOf(const Mesh& mesh, SurfelPlacement placement, std::uint32_t count) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(mesh);
    Scene scene = b.build();
    scene.bake.placement = placement;
    return surfelSpacing(placeSurfels(scene, count).surfels);
}

TEST(EdgePartners, AreTheOtherTriangleOfAnEdge) {
    const std::vector<std::uint32_t> partner = edgePartners(flatPatch(1));
    EXPECT_EQ(partner, (std::vector<std::uint32_t>{kNoEdge, 5, kNoEdge, kNoEdge, kNoEdge, 1}));
}

TEST(EdgePartners, StopAtFansAndAtTurnedTriangles) {
    Mesh turned = flatPatch(1);
    std::swap(turned.indices[4], turned.indices[5]);
    for (const std::uint32_t p : edgePartners(turned))
        EXPECT_EQ(p, kNoEdge);
    Mesh fan = flatPatch(1); // a third sheet on the diagonal
    fan.positions.emplace_back(0.5f, 0.5f, 1.f);
    fan.indices.insert(fan.indices.end(), {1, 2, 4});
    for (const std::uint32_t p : edgePartners(fan))
        EXPECT_EQ(p, kNoEdge);
}

TEST(EdgePartners, JoinVerticesAtTheSamePlace) {
    const Mesh closed = box(glm::vec3(0), glm::vec3(1), false); // no vertex is shared
    for (const std::uint32_t p : edgePartners(closed))
        EXPECT_NE(p, kNoEdge);
}

TEST(SurfaceWalk, GoesStraightOverAPlaneAndStopsAtItsBorder) {
    const Mesh mesh = flatPatch(7);
    const SurfaceWalk walk(mesh);
    std::mt19937 rng(3);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 2000; ++i) {
        const MeshPoint from{std::uint32_t(rng() % mesh.triangleCount()), {0.3f, 0.4f * unit(rng)}};
        const glm::vec3 p = at(mesh, from);
        const glm::vec3 step(2 * unit(rng) - 1, 2 * unit(rng) - 1, 0);
        float share = 1; // of the step, up to the border
        for (int k = 0; k < 2; ++k)
            share = std::min(share, step[k] > 0 ? (1 - p[k]) / step[k] : -p[k] / step[k]);
        const MeshPoint to = walk.move(from, step);
        expectInside(to);
        EXPECT_LT(glm::length(at(mesh, to) - (p + step * share)), 1e-4f);
    }
}

TEST(SurfaceWalk, TurnsWithTheSurfaceAndKeepsItsLength) {
    // A strip of unit squares folded to a square prism: each edge a right angle.
    Mesh mesh;
    for (const float y : {0.f, 1.f})
        for (int k = 0; k < 4; ++k)
            mesh.positions.emplace_back(k == 1 || k == 2, y, k >= 2);
    for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t a = k, b = (k + 1) % 4, c = a + 4, d = b + 4;
        mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
    }
    const SurfaceWalk walk(mesh);
    // Along the first face's x for 4.2 and up by 0.3: round once, 0.2 further on.
    const MeshPoint from{0, {0.2f, 0.4f}}; // (0.4, 0.2, 0)
    const glm::vec3 p = at(mesh, from);
    const MeshPoint round = walk.move(from, glm::vec3(4.2f, 0.3f, 0));
    EXPECT_LT(glm::length(at(mesh, round) - (p + glm::vec3(0.2f, 0.3f, 0))), 1e-5f);
    const MeshPoint corner = walk.move(from, glm::vec3(1.1f, 0.3f, 0));
    EXPECT_LT(glm::length(at(mesh, corner) - glm::vec3(1, 0.5f, 0.5f)), 1e-5f);
}

TEST(SurfelSpacing, KnowsAHexagonalLatticeAndRandomPoints) {
    Surfels lattice, random;
    std::mt19937 rng(1);
    std::uniform_real_distribution<float> unit(0, 100);
    const auto add = [](Surfels& s, float x, float y, float area) {
        s.position.emplace_back(x, y, 0);
        s.normal.emplace_back(0, 0, 1);
        s.area.push_back(area);
        s.instance.push_back(0);
    };
    for (int j = 0; j < 100; ++j)
        for (int i = 0; i < 100; ++i) {
            add(lattice, float(i) + 0.5f * float(j % 2), float(j) * std::sqrt(0.75f),
                std::sqrt(0.75f));
            add(random, unit(rng), unit(rng), 1);
        }
    const SurfelSpacing hexagonal = surfelSpacing(lattice), poisson = surfelSpacing(random);
    EXPECT_NEAR(hexagonal.mean, 1, 1e-4);
    EXPECT_NEAR(hexagonal.spread, 0, 1e-3);
    // Mean 1 / (2 sqrt(density)), deviation sqrt((4 - pi) / pi) of it; the square's rim adds some.
    EXPECT_NEAR(poisson.mean, 0.5 / std::sqrt(2 / std::sqrt(3.0)), 0.01);
    EXPECT_NEAR(poisson.spread, std::sqrt(4 / std::numbers::pi - 1), 0.02);
    // Whatever the order of instances, and beside a surfel that stands for no area.
    Surfels mixed;
    for (std::size_t i = 0; i < lattice.size(); ++i) {
        add(mixed, lattice.position[i].x, lattice.position[i].y, lattice.area[i]);
        add(mixed, lattice.position[i].x, lattice.position[i].y, lattice.area[i]);
        mixed.instance.back() = 1;
    }
    add(mixed, -1, 0, limn::kLeastSurfelArea);
    EXPECT_EQ(surfelSpacing(mixed).count, 2 * hexagonal.count);
    EXPECT_NEAR(surfelSpacing(mixed).mean, hexagonal.mean, 1e-4);
    EXPECT_NEAR(surfelSpacing(mixed).spread, 0, 1e-3);
}

TEST(Placement, RelaxedIsMoreEvenThanHaltonThanRandom) {
    for (const Mesh& mesh : {flatPatch(1), box(glm::vec3(0), glm::vec3(1, 2, 3), true)}) {
        const SurfelSpacing relaxed = spacingOf(mesh, SurfelPlacement::Relaxed, 4000);
        const SurfelSpacing halton = spacingOf(mesh, SurfelPlacement::Halton, 4000);
        const SurfelSpacing random = spacingOf(mesh, SurfelPlacement::Random, 4000);
        EXPECT_EQ(relaxed.count, 4000U);
        EXPECT_GT(relaxed.mean, 0.84);
        EXPECT_LT(relaxed.spread, 0.1);
        EXPECT_GT(relaxed.mean, halton.mean + 0.2);
        EXPECT_GT(halton.mean, random.mean + 0.04);
        EXPECT_LT(relaxed.spread, halton.spread / 3);
        EXPECT_LT(halton.spread, random.spread - 0.1);
    }
}

TEST(Placement, RelaxationCrossesTriangles) {
    // As many triangles as surfels, so that a Halton point is the only one in its triangle.
    const SurfelSpacing relaxed = spacingOf(wavyPatch(), SurfelPlacement::Relaxed, 4000);
    EXPECT_GT(relaxed.mean, 0.84);
    EXPECT_LT(relaxed.spread, 0.1);
}

TEST(Placement, RelaxedLeavesAMarginAtBordersAndTakesNoneAway) {
    // On the unit square the mean of |x - 1/2| stays 1/4 if the points keep their density.
    const MeshSurfels s = placeSurfels(flatPatch(1), 2500, false, SurfelPlacement::Relaxed);
    double sum = 0;
    int rim = 0;
    for (const glm::vec3 p : s.position) {
        sum += std::abs(p.x - 0.5);
        rim += std::min(p.x, 1 - p.x) < 0.002f;
    }
    EXPECT_NEAR(sum / 2500, 0.25, 0.003);
    EXPECT_LT(rim, 10); // a spacing is 0.021; Halton has 10 there
}

TEST(Placement, IsTheSameAtAnyNumberOfThreadsAndScale) {
    const Mesh mesh = wavyPatch();
    const MeshSurfels many = placeSurfels(mesh, 3000, true, SurfelPlacement::Relaxed);
    {
        const ThreadLimit limit(1);
        const MeshSurfels one = placeSurfels(mesh, 3000, true, SurfelPlacement::Relaxed);
        EXPECT_EQ(one.position, many.position);
        EXPECT_EQ(one.triangle, many.triangle);
    }
    for (const float scale : {0x1p-10f, 0x1p13f, 1e-3f, 1e4f}) {
        Mesh scaled = mesh;
        for (glm::vec3& p : scaled.positions)
            p *= scale;
        const MeshSurfels s = placeSurfels(scaled, 3000, true, SurfelPlacement::Relaxed);
        const float tolerance = 1e-3f * std::sqrt(many.area);
        for (std::size_t i = 0; i < s.size(); ++i)
            EXPECT_LT(glm::length(s.position[i] / scale - many.position[i]), tolerance) << scale;
    }
}

TEST(Placement, PairsStandBackToBackInTheirTriangles) {
    const MeshSurfels s = placeSurfels(wavyPatch(), 500, true, SurfelPlacement::Relaxed);
    ASSERT_EQ(s.size(), 1000U);
    for (std::size_t i = 0; i < 500; ++i) {
        EXPECT_EQ(s.position[i], s.position[i + 500]);
        EXPECT_EQ(s.normal[i], -s.normal[i + 500]);
        expectInside({s.triangle[i], s.barycentric[i]});
    }
}

TEST(Placement, OneTriangleTakesOneSurfelAndMany) {
    const Mesh mesh = flatShaded({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0);
    EXPECT_EQ(placeSurfels(mesh, 1, false, SurfelPlacement::Relaxed).size(), 1U);
    EXPECT_GT(spacingOf(mesh, SurfelPlacement::Relaxed, 1000).mean, 0.84);
}

TEST(Placement, MeshesWithoutAreaGetNoSurfelsAndCauseNoHarm) {
    const std::vector<glm::vec3> line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(flatShaded(line, 0));
    Scene scene = b.build();
    EXPECT_EQ(placeSurfels(scene, 1000).surfels.size(), 0U);
    b.add(flatPatch(2));
    scene = b.build();
    const SurfelSet set = placeSurfels(scene, 1000);
    EXPECT_EQ(set.surfels.size(), 1000U);
    const MeshSurfels none = placeSurfels(flatShaded(line, 0), 300, true, SurfelPlacement::Relaxed);
    const SurfelOwners owners(flatShaded(line, 0), none);
    EXPECT_LT(owners.surfelAt(0, 0.3f, 0.3f, false), 300U);
}

TEST(Placement, SheetsOnTopOfOneAnotherStayFastAndFinite) {
    Mesh mesh;
    for (int copy = 0; copy < 3000; ++copy)
        for (const glm::vec3 p : {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)}) {
            mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
            mesh.positions.push_back(p);
        }
    const MeshSurfels s = placeSurfels(mesh, 20000, false, SurfelPlacement::Relaxed);
    for (std::size_t i = 0; i < s.size(); ++i) {
        expectInside({s.triangle[i], s.barycentric[i]});
        EXPECT_TRUE(std::isfinite(s.position[i].x + s.position[i].y + s.position[i].z));
    }
}

TEST(SurfelOwners, NeedlesTakeNoMoreThanTheirShare) {
    // 20 000 needles of 1 m by 1 um would have half a million cells each.
    Mesh mesh;
    for (int i = 0; i < 20000; ++i)
        for (const glm::vec3 p :
             {glm::vec3(0), glm::vec3(1, float(i), 0), glm::vec3(1, float(i) + 1e-6f, 0)}) {
            mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
            mesh.positions.push_back(p);
        }
    const MeshSurfels s = placeSurfels(mesh, 100, false, SurfelPlacement::Relaxed);
    const SurfelOwners owners(mesh, s);
    for (std::uint32_t t = 0; t < 20000; t += 1000)
        EXPECT_LT(owners.surfelAt(t, 0.5f, 0.4f, false), 100U);
}

} // namespace
} // namespace limn::placement_test
