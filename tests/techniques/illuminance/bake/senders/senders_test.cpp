// SPDX-License-Identifier: MIT
#include "engine/math/nearest_point.h"
#include "engine/math/sampling.h"
#include "engine/techniques/illuminance/bake/senders/cluster_tree.h"
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"
#include "engine/techniques/illuminance/bake/senders/surfels.h"
#include "engine/techniques/illuminance/format/tree_shape.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>

namespace limn::senders_test {
namespace {

using namespace simple;

Scene twoRooms() {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    Material curtain = lambert(glm::vec3(0.5f));
    curtain.doubleSided = true;
    b.addMaterial(curtain);
    const std::uint32_t room = b.addMesh(box(glm::vec3(0), glm::vec3(1, 2, 3), true));
    b.addInstance(room);
    b.addInstance(room, glm::mat4(glm::vec4(2, 0, 0, 0), glm::vec4(0, 1, 0, 0),
                                  glm::vec4(0, 0, 0.5f, 0), glm::vec4(7, 0, 0, 1)));
    b.add(quad({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 1));
    return b.build();
}

TEST(Surfels, AreasSumToTheLitSidesExactly) {
    const Scene scene = twoRooms();
    const SurfelSet set = placeSurfels(scene, 5000);
    // Rooms of 22 m^2 and 2 (2 * 2 + 2 * 1.5 + 2 * 1.5) = 20 m^2; a curtain of 1 m^2 with two
    // sides. The second room's faces stretch differently.
    std::vector<double> area(3);
    for (std::size_t i = 0; i < set.surfels.size(); ++i)
        area[set.surfels.instance[i]] += set.surfels.area[i];
    EXPECT_NEAR(area[0], 22, 1e-3);
    EXPECT_NEAR(area[1], 20, 1e-3);
    EXPECT_NEAR(area[2], 2, 1e-4);
    EXPECT_NEAR(double(set.surfels.size()), 5000, 100);
}

/// Two squares of one mesh side by side; the second one has the two-sided material.
Scene squaresOfTwoKinds() {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    Material curtain = lambert(glm::vec3(0.5f));
    curtain.doubleSided = true;
    b.addMaterial(curtain);
    const std::uint32_t square = b.addMesh(quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0));
    b.addInstance(square);
    b.addInstance(square, glm::mat4(glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0),
                                    glm::vec4(0, 0, 1, 0), glm::vec4(3, 0, 0, 1)));
    Scene scene = b.build();
    scene.instances[1].material = 1;
    return scene;
}

TEST(Surfels, AMeshMayBeOneSidedHereAndTwoSidedThere) {
    const Scene scene = squaresOfTwoKinds();
    const SurfelSet set = placeSurfels(scene, 300);
    const std::uint32_t middle = set.instanceBegin[1];
    ASSERT_EQ(set.surfels.size(), 3 * middle);
    std::vector<double> area(2);
    for (std::size_t i = 0; i < set.surfels.size(); ++i) {
        area[set.surfels.instance[i]] += double(set.surfels.area[i]);
        EXPECT_EQ(set.surfels.normal[i].z > 0, i < 2 * middle);
    }
    EXPECT_NEAR(area[0], 1, 1e-5);
    EXPECT_NEAR(area[1], 2, 1e-5);
    // Every surfel is a leaf of the one tree, once.
    const ClusterTree tree = buildClusterTree(scene, set);
    ASSERT_EQ(tree.surfels, set.surfels.size());
    EXPECT_EQ(tree.left.size(), tree.leaves() - 1);
    std::vector<int> parents(tree.size());
    for (std::size_t k = 0; k < tree.left.size(); ++k) {
        ++parents[tree.left[k]];
        ++parents[tree.right[k]];
    }
    EXPECT_EQ(std::ranges::count(parents, 1), std::ptrdiff_t(tree.size() - 1));
}

// Relaxation pushes surfels of the large faces onto the rim, which gets more of them than its area
// asks for.
TEST(Surfels, AreasThatTheyOwnAreThoseOfTheirSides) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(box({-0.5f, -0.003f, -0.5f}, {0.5f, 0.003f, 0.5f}, false));
    b.add(box({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}, false),
          glm::mat4(glm::vec4(2, 0, 0, 0), glm::vec4(0, 0.5f, 0, 0), glm::vec4(0, 0, 3, 0),
                    glm::vec4(7, 0, 0, 1)));
    const Scene scene = b.build();
    const SurfelSet set = placeSurfels(scene, 3000);
    const OwnerTables owners(scene, set);
    const std::vector<float> area = ownedAreas(scene, set, owners);
    double rim = 0, placedFor = 0, plate = 0, block[3] = {};
    for (std::size_t i = 0; i < area.size(); ++i) {
        EXPECT_GT(area[i], 0);
        const glm::vec3 n = glm::abs(set.surfels.normal[i]);
        if (set.surfels.instance[i] == 0) {
            plate += double(area[i]);
            rim += n.y < 0.5f ? double(area[i]) : 0;
            placedFor += n.y < 0.5f ? double(set.surfels.area[i]) : 0;
        } else {
            block[n.x > 0.5f ? 0 : n.y > 0.5f ? 1 : 2] += double(area[i]);
        }
    }
    EXPECT_GT(placedFor, 3 * 0.024) << "nothing to put right";
    EXPECT_NEAR(rim, 0.024, 0.002);
    EXPECT_NEAR(plate, 2.024, 1e-4);
    EXPECT_NEAR(block[0], 2 * 3 * 0.5, 0.03);
    EXPECT_NEAR(block[1], 2 * 2 * 3, 0.03);
    EXPECT_NEAR(block[2], 2 * 2 * 0.5, 0.03);
}

TEST(Surfels, LieOnTheirTrianglesAndFaceTheirSide) {
    const Scene scene = twoRooms();
    const SurfelSet set = placeSurfels(scene, 2000);
    for (std::size_t i = 0; i < set.surfels.size(); ++i) {
        const Instance& instance = scene.instances[set.surfels.instance[i]];
        const auto [a, b, c] = scene.meshOf(instance).triangle(set.surfels.triangle[i]);
        const auto& p = scene.meshOf(instance).positions;
        const glm::vec2 uv = set.surfels.barycentric[i];
        const glm::vec3 at =
            instance.toWorld * glm::vec4(p[a] * (1 - uv.x - uv.y) + p[b] * uv.x + p[c] * uv.y, 1);
        EXPECT_LT(glm::length(at - set.surfels.position[i]), 1e-5f);
        EXPECT_NEAR(glm::length(set.surfels.normal[i]), 1, 1e-5);
    }
}

TEST(NearestPoint, AgreesWithBruteForce) {
    std::mt19937 rng(1);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<glm::vec3> points, normals;
    const auto vec = [&] { return glm::vec3(unit(rng), unit(rng), unit(rng)); };
    for (int i = 0; i < 500; ++i) {
        points.push_back(vec());
        normals.push_back(glm::normalize(vec()));
    }
    const float spacing = 0.2f;
    const NearestPoint nearest(points, normals, spacing);
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 p = vec(), n = glm::normalize(vec());
        const auto cost = [&](std::uint32_t k) {
            return glm::dot(points[k] - p, points[k] - p) +
                   16 * spacing * spacing * (1 - glm::dot(normals[k], n));
        };
        float best = 1e30f;
        for (std::uint32_t k = 0; k < points.size(); ++k)
            best = std::min(best, cost(k));
        EXPECT_NEAR(cost(nearest.find(p, n)), best, 1e-6);
        std::vector<float> all;
        for (std::uint32_t k = 0; k < points.size(); ++k)
            all.push_back(cost(k));
        std::sort(all.begin(), all.end());
        std::array<NearestPoint::Near, 5> some;
        ASSERT_EQ(nearest.findSome(p, n, some), 5U);
        for (std::size_t k = 0; k < some.size(); ++k) {
            EXPECT_NEAR(some[k].cost, all[k], 1e-6);
            EXPECT_EQ(some[k].cost, cost(some[k].point));
        }
    }
    std::array<NearestPoint::Near, 501> more;
    EXPECT_EQ(nearest.findSome(glm::vec3(0), glm::vec3(0, 0, 1), more), 500U);
    EXPECT_EQ(NearestPoint({}, {}, 1).findSome(glm::vec3(0), glm::vec3(0, 0, 1), more), 0U);
}

TEST(SurfelOwners, GiveANearbySurfelOfTheSameFace) {
    const Mesh mesh = box(glm::vec3(0), glm::vec3(1), true);
    const MeshSurfels surfels = placeSurfels(mesh, 600, true, SurfelPlacement::Relaxed);
    const SurfelOwners owners(mesh, surfels);
    std::mt19937 rng(2);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 2000; ++i) {
        const auto t = std::uint32_t(rng() % mesh.triangleCount());
        const glm::vec2 uv = sampleTriangle({unit(rng), unit(rng)});
        const auto [a, b, c] = mesh.triangle(t);
        const glm::vec3 p = mesh.positions[a] * (1 - uv.x - uv.y) + mesh.positions[b] * uv.x +
                            mesh.positions[c] * uv.y;
        const std::uint32_t front = owners.surfelAt(t, uv.x, uv.y, false),
                            back = owners.surfelAt(t, uv.x, uv.y, true);
        EXPECT_LT(glm::length(surfels.position[front] - p), 4 * std::sqrt(surfels.area));
        EXPECT_GT(glm::dot(surfels.normal[front], mesh.normals[a]), 0.9f);
        EXPECT_LT(glm::dot(surfels.normal[back], mesh.normals[a]), -0.9f);
    }
}

/// A triangle of right angle at each of its corners in turn, a needle, an obtuse one, and one that
/// is almost a line.
std::vector<Mesh> hardTriangles() {
    const std::vector<std::array<glm::vec3, 3>> corners = {
        {glm::vec3(0), {7, 0, 0}, {0, 2, 0}},
        {glm::vec3(7, 0, 0), {0, 2, 0}, glm::vec3(0)},
        {glm::vec3(0, 2, 0), glm::vec3(0), {7, 0, 0}},
        {glm::vec3(0), {9, 0, 0}, {9, 0.01f, 0}},
        {glm::vec3(0), {5, 0, 0}, {2, 0.3f, 0}},
        {glm::vec3(0), {3, 3, 0}, {1, 1.0001f, 0}}};
    std::vector<Mesh> meshes;
    for (const std::array<glm::vec3, 3>& c : corners) {
        Mesh mesh;
        mesh.positions.assign(c.begin(), c.end());
        mesh.normals.assign(3, glm::vec3(0, 0, 1));
        mesh.indices = {0, 1, 2};
        meshes.push_back(mesh);
    }
    return meshes;
}

TEST(SurfelOwners, CellsCoverTheirTriangleOnce) {
    std::mt19937 rng(3);
    std::uniform_real_distribution<float> unit(0, 1);
    for (const Mesh& mesh : hardTriangles()) {
        const SurfelOwners owners(mesh, placeSurfels(mesh, 50, false, SurfelPlacement::Relaxed));
        std::vector<SurfelOwners::Cell> cells(owners.cells());
        std::vector<int> seen(owners.cells());
        double sum = 0;
        owners.forCellsOf(0, [&](const SurfelOwners::Cell& cell) {
            EXPECT_GT(cell.share, 0);
            sum += cell.share;
            ++seen[cell.index];
            cells[cell.index] = cell;
            const glm::vec2 uv = cell.middle();
            EXPECT_GT(std::min({uv.x, uv.y, 1 - uv.x - uv.y}), 0) << cell.index;
            EXPECT_EQ(owners.cellAt(0, uv.x, uv.y).cell, cell.index);
        });
        EXPECT_NEAR(sum, 1, 1e-12);
        EXPECT_LE(*std::ranges::max_element(seen), 1);
        constexpr int kPoints = 40000;
        std::vector<int> found(owners.cells());
        for (int i = 0; i < kPoints; ++i) {
            const glm::vec2 uv = sampleTriangle({unit(rng), unit(rng)});
            const SurfelOwners::Place place = owners.cellAt(0, uv.x, uv.y);
            ASSERT_EQ(seen[place.cell], 1);
            ++found[place.cell];
            // The place lies in the cell, and in the part of it.
            const SurfelOwners::Cell& cell = cells[place.cell];
            const glm::vec2 way = uv - cell.origin;
            const glm::vec2 in = glm::inverse(glm::mat2(cell.across, cell.up)) * way;
            EXPECT_NEAR(in.x, 0.5, 0.5 + 1e-3);
            EXPECT_NEAR(in.y, 0.5, 0.5 + 1e-3);
            constexpr std::uint32_t kAcross = SurfelOwners::kAcross;
            const glm::vec2 part =
                (glm::vec2(place.part % kAcross, place.part / kAcross) + 0.5f) / float(kAcross);
            EXPECT_NEAR(in.x, part.x, 0.125 + 1e-3);
            EXPECT_NEAR(in.y, part.y, 0.125 + 1e-3);
        }
        for (std::size_t c = 0; c < found.size(); ++c)
            if (seen[c] > 0) {
                EXPECT_NEAR(found[c], kPoints * cells[c].share,
                            6 * std::sqrt(kPoints * cells[c].share) + 1)
                    << c;
            }
    }
}

// A quarter of the surfels' spacing is the side of a cell. It takes two for each of the least
// number, of which the triangle covers half, wherever its right angle is.
TEST(SurfelOwners, CellsAreAsManyAsTheAreaNeeds) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const Mesh mesh = hardTriangles()[corner];
        const SurfelOwners owners(mesh, placeSurfels(mesh, 400, false, SurfelPlacement::Relaxed));
        const double area = 7, side = std::sqrt(area / 400) / 4;
        EXPECT_LT(owners.cells(), 2 * area / (side * side) + 9 / side + 1) << corner;
    }
}

TEST(ClusterTree, IsOneBinaryTreeWithParentsAfterChildren) {
    Scene scene = twoRooms();
    const SurfelSet set = placeSurfels(scene, 1000);
    for (const Clustering how : {Clustering::Agglomerative, Clustering::KdTree}) {
        scene.bake.clustering = how;
        const ClusterTree tree = buildClusterTree(scene, set);
        ASSERT_EQ(tree.left.size() + 1, tree.leaves());
        std::vector<int> parents(tree.size());
        for (std::uint32_t k = 0; k < tree.left.size(); ++k) {
            const std::uint32_t node = tree.leaves() + k;
            for (const std::uint32_t child : {tree.left[k], tree.right[k]}) {
                EXPECT_LT(child, node);
                EXPECT_EQ(tree.parent[child], node);
                ++parents[child];
            }
            EXPECT_GT(tree.leftWeight[k], 0);
            EXPECT_LT(tree.leftWeight[k], 1);
        }
        for (std::uint32_t n = 0; n + 1 < tree.size(); ++n)
            EXPECT_EQ(parents[n], 1) << n;
        EXPECT_EQ(tree.parent[tree.size() - 1], ~0U);
    }
}

TEST(ClusterTree, InstancesRepeatTheirMeshsTree) {
    Scene scene = twoRooms();
    const SurfelSet set = placeSurfels(scene, 1000);
    for (const Clustering how : {Clustering::Agglomerative, Clustering::KdTree}) {
        scene.bake.clustering = how;
        const ClusterTree tree = buildClusterTree(scene, set);
        const std::uint32_t n = set.instanceBegin[1], inner = n - 1;
        const auto inSecond = [&](std::uint32_t child) {
            return child < n ? child + n : child + inner;
        };
        for (std::uint32_t k = 0; k < inner; ++k) {
            EXPECT_EQ(tree.left[inner + k], inSecond(tree.left[k]));
            EXPECT_EQ(tree.right[inner + k], inSecond(tree.right[k]));
        }
    }
}

TEST(TreeShape, OfAKnownTree) {
    ClusterTree tree;
    tree.surfels = 3;
    tree.skyCells = 1;
    tree.left = {0, 4, 5}; // ((0 1) 2) sky
    tree.right = {1, 2, 3};
    const TreeShape shape = treeShapeOf(tree);
    EXPECT_EQ(shape.maxDepth, 3U);
    EXPECT_NEAR(shape.meanDepth, 8 / 3.0, 1e-12);
    EXPECT_NEAR(shape.balance, 0.75, 1e-12);
}

TEST(Sky, CellsHaveEqualSolidAngleAndContainTheirDirection) {
    const Scene scene = twoRooms();
    const ClusterTree tree = buildClusterTree(scene, placeSurfels(scene, 100));
    for (std::uint32_t c = 0; c < kSkyCells; ++c)
        EXPECT_EQ(skyCellOf(tree.skyDirection[c]), c);
    const DirectionSet set(256000, true, 9);
    std::vector<int> hits(kSkyCells);
    for (std::uint32_t i = 0; i < set.count; ++i)
        ++hits[skyCellOf(set[i])];
    for (const int h : hits)
        EXPECT_NEAR(h, 1000, 60);
}

} // namespace
} // namespace limn::senders_test
