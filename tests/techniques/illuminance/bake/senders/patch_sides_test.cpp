// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/patch_sides.h"

#include "engine/core/parallel.h"
#include "engine/math/sampling.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"
#include "tests/techniques/illuminance/bake/parted_hall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

namespace limn::patch_sides_test {
namespace {

constexpr float kWall = 3.75f; ///< not at a border of cells

/// The longest side of a mesh's cells on a triangle [m].
float cellWidth(const Mesh& mesh, const SurfelOwners& owners, std::uint32_t triangle) {
    float width = 0;
    owners.forCellsOf(triangle, [&](const SurfelOwners::Cell& cell) {
        const glm::vec3 from = trianglePoint(mesh, triangle, cell.at({0, 0}));
        for (const glm::vec2 to : {glm::vec2(1, 0), glm::vec2(0, 1)})
            width = std::max(width, glm::length(trianglePoint(mesh, triangle, cell.at(to)) - from));
    });
    return width;
}

/// Of random points of the hall whose distance from the wall is at least `from` times the width of
/// a cell of the table: how many belong to surfels beyond the wall.
int beyondWall(const Scene& scene, const SurfelSet& set, const OwnerTables& owners, float wall,
               float from = 1) {
    std::mt19937 rng(2);
    std::uniform_real_distribution<float> unit(0, 1);
    const Mesh& mesh = scene.assets->meshes[0];
    int beyond = 0;
    std::vector<float> width;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
        width.push_back(cellWidth(mesh, owners.tableOf(0), t));
    for (int i = 0; i < 20000; ++i) {
        const auto t = std::uint32_t(rng() % mesh.triangleCount());
        const glm::vec2 uv = sampleTriangle({unit(rng), unit(rng)});
        const float x = worldPoint(scene, scene.instances[0], {t, uv}).position.x,
                    cells = std::max(kWall - x, x - kWall - wall) / width[t];
        if (cells < from)
            continue;
        const std::uint32_t owner = owners.surfelAt(0, t, uv.x, uv.y, false);
        EXPECT_EQ(set.surfels.instance[owner], 0U);
        beyond += (set.surfels.position[owner].x < kWall) != (x < kWall);
    }
    return beyond;
}

TEST(PatchSides, PatchesEndAtWalls) {
    for (const float wall : {0.f, 0.01f, 0.1f}) {
        const Scene scene = partedHall(wall, 500, kWall);
        const TraceScene trace(scene);
        const SurfelSet set = placeSurfels(scene, 500);
        OwnerTables owners(scene, set);
        EXPECT_GT(beyondWall(scene, set, owners, wall), 0) << "nothing to cut";
        const PatchSides sides = findPatchSides(trace, set, owners, {});
        EXPECT_GT(sides.rays, 0U);
        owners.part(sides);
        EXPECT_EQ(beyondWall(scene, set, owners, wall), 0) << wall;
    }
}

/// The same scene with each triangle of its first mesh divided into four, `times` times.
Scene divided(const Scene& scene, int times) {
    auto assets = std::make_shared<Assets>(*scene.assets);
    Mesh& mesh = assets->meshes[0];
    for (int k = 0; k < times; ++k) {
        Mesh fine;
        for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
            const auto begin = std::uint32_t(fine.positions.size());
            for (const glm::vec2 uv : {glm::vec2(0), glm::vec2(1, 0), glm::vec2(0, 1),
                                       glm::vec2(0.5f, 0), glm::vec2(0.5f), glm::vec2(0, 0.5f)}) {
                fine.positions.push_back(trianglePoint(mesh, t, uv));
                fine.normals.push_back(triangleNormal(mesh, t));
            }
            for (const std::uint32_t corner : {0U, 3U, 5U, 3U, 1U, 4U, 5U, 4U, 2U, 3U, 4U, 5U})
                fine.indices.push_back(begin + corner);
        }
        mesh = fine;
    }
    Scene result = scene;
    result.assets = std::move(assets);
    return result;
}

// Triangles smaller than cells: those of one place that a wall parts from their nearest surfel
// share an owner.
TEST(PatchSides, PatchesOfSmallTrianglesEndAtWalls) {
    for (const float wall : {0.f, 0.01f, 0.1f}) {
        const Scene scene = divided(partedHall(wall, 500, kWall), 6);
        ASSERT_GT(scene.assets->meshes[0].triangleCount(), 16 * 500U);
        const TraceScene trace(scene);
        const SurfelSet set = placeSurfels(scene, 500);
        OwnerTables owners(scene, set);
        EXPECT_TRUE(owners.tableOf(0).isOneCell(0));
        EXPECT_GT(beyondWall(scene, set, owners, wall), 0) << "nothing to cut";
        owners.part(findPatchSides(trace, set, owners, {}));
        EXPECT_EQ(beyondWall(scene, set, owners, wall), 0) << wall;
    }
}

/// The same with whole cells: all of a cell belongs to the owner of a part in its middle.
PatchSides withWholeCells(PatchSides sides) {
    for (std::size_t i = 0; i < sides.owner.size(); ++i)
        for (std::uint32_t& owner : sides.owner[i])
            if (owner & PatchSides::kSplit) {
                constexpr std::uint32_t kMiddle =
                    SurfelOwners::kParts / 2 + SurfelOwners::kAcross / 2;
                owner =
                    sides.parts[i][(owner & ~PatchSides::kSplit) * SurfelOwners::kParts + kMiddle];
            }
    return sides;
}

// The wall is a sheet, or a solid of 1 cm. Points nearer to it than half the width of a part may
// belong to surfels beyond it.
TEST(PatchSides, CellsThatAWallCrossesAreSplit) {
    for (const float wall : {0.f, 0.01f}) {
        const Scene scene = partedHall(wall, 500, kWall);
        const TraceScene trace(scene);
        const SurfelSet set = placeSurfels(scene, 500);
        OwnerTables owners(scene, set);
        const PatchSides sides = findPatchSides(trace, set, owners, {});
        owners.part(withWholeCells(sides));
        const int whole = beyondWall(scene, set, owners, wall, 0);
        owners.part(sides);
        const int split = beyondWall(scene, set, owners, wall, 0);
        std::printf("wall %g m: %d points beyond it with whole cells, %d with parts\n",
                    double(wall), whole, split);
        EXPECT_GT(whole, 50);
        EXPECT_LT(split, whole / 2);
        EXPECT_EQ(beyondWall(scene, set, owners, wall, 0.75f / SurfelOwners::kAcross), 0);
    }
}

/// A room of 8 x 3 x 4 m and a plate of 2 x 2 m, 10 mm thick, that hangs 0.2 mm below its ceiling:
/// both are far less than a quarter of the surfels' spacing.
constexpr float kPlateBegin = 3, kPlateEnd = 5, kPlateNear = 1, kPlateFar = 3;

Scene roomWithPlate() {
    using namespace simple;
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.7f)));
    b.add(box(glm::vec3(0), glm::vec3(8, 3, 4), true));
    b.add(box({kPlateBegin, 2.9898f, kPlateNear}, {kPlateEnd, 2.9998f, kPlateFar}, false));
    return b.build();
}

/// How far a place lies outside the plate; negative below it [m].
float outsidePlate(glm::vec3 p) {
    return std::max(std::max(kPlateBegin - p.x, p.x - kPlateEnd),
                    std::max(kPlateNear - p.z, p.z - kPlateFar));
}

/// Of random points of the ceiling, those that belong to surfels on the other side of the plate's
/// edge.
struct Strangers {
    int open = 0;    ///< anywhere beside the plate
    int openFar = 0; ///< the same, further from its edge than half a cell of the table
    int covered = 0; ///< in the gap, further from its edge than a cell and a half
};

Strangers acrossPlateEdge(const Scene& scene, const SurfelSet& set, const OwnerTables& owners) {
    std::mt19937 rng(3);
    std::uniform_real_distribution<float> unit(0, 1);
    const Mesh& mesh = scene.assets->meshes[0];
    Strangers result;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
        const float cell = cellWidth(mesh, owners.tableOf(0), t);
        for (int i = 0; i < 20000; ++i) {
            const glm::vec2 uv = sampleTriangle({unit(rng), unit(rng)});
            const glm::vec3 p = worldPoint(scene, scene.instances[0], {t, uv}).position;
            if (p.y < 2.999f)
                break;
            const float outside = outsidePlate(p);
            const std::uint32_t owner = owners.surfelAt(0, t, uv.x, uv.y, false);
            if ((outsidePlate(set.surfels.position[owner]) > 0) == (outside > 0))
                continue;
            result.open += outside > 0;
            result.openFar += outside > cell / 2;
            result.covered += outside < -1.5f * cell;
        }
    }
    return result;
}

TEST(PatchSides, CeilingsBesideThinPlatesDoNotBelongToSurfelsInTheGap) {
    const Scene scene = roomWithPlate();
    const TraceScene trace(scene);
    const SurfelSet set = placeSurfels(scene, 4000);
    OwnerTables owners(scene, set);
    const Strangers before = acrossPlateEdge(scene, set, owners);
    EXPECT_GT(before.openFar, 0) << "nothing to cut";
    owners.part(findPatchSides(trace, set, owners, {}));
    const Strangers after = acrossPlateEdge(scene, set, owners);
    EXPECT_EQ(after.openFar, 0);
    EXPECT_LT(after.open, before.open / 10) << before.open; // cells that the edge cuts
    EXPECT_EQ(after.covered, 0);
}

TEST(PatchSides, SayWhichSurfelsTheyChange) {
    const Scene scene = partedHall(0, 500);
    const TraceScene trace(scene);
    const SurfelSet set = placeSurfels(scene, 500);
    const OwnerTables owners(scene, set);
    const PatchSides sides = findPatchSides(trace, set, owners, {});
    ASSERT_EQ(sides.changed.size(), set.surfels.size());
    ASSERT_EQ(sides.owner[0].size(), owners.tableOf(0).cells());
    OwnerTables parted(scene, set);
    parted.part(sides);
    std::vector<bool> changed(set.surfels.size());
    for (std::uint32_t c = 0; c < owners.tableOf(0).cells(); ++c)
        for (std::uint32_t part = 0; part < SurfelOwners::kParts; ++part) {
            const std::uint32_t own = parted.ofCell(0, {c, part}, false);
            if (own != owners.tableOf(0).front(c))
                changed[own] = changed[owners.tableOf(0).front(c)] = true;
        }
    for (std::uint32_t s = 0; s < set.instanceBegin[1]; ++s)
        EXPECT_EQ(sides.changed[s] != 0, changed[s]) << s;
}

TEST(PatchSides, AreNoneWithoutWallsAndAlikeForAnyNumberOfThreads) {
    Scene open = partedHall(0, 500);
    open.instances.resize(1);
    {
        const SurfelSet set = placeSurfels(open, 500);
        const OwnerTables owners(open, set);
        const TraceScene trace(open);
        const PatchSides sides = findPatchSides(trace, set, owners, {});
        EXPECT_TRUE(sides.owner[0].empty());
        EXPECT_TRUE(sides.changed.empty());
    }
    const Scene scene = partedHall(0.1f, 500);
    const TraceScene trace(scene);
    const SurfelSet set = placeSurfels(scene, 500);
    const OwnerTables owners(scene, set);
    const auto found = [&](int threads) {
        const ThreadLimit limit(threads);
        return findPatchSides(trace, set, owners, {});
    };
    const PatchSides one = found(1), two = found(2);
    EXPECT_EQ(one.owner, two.owner);
    EXPECT_EQ(one.parts, two.parts);
    EXPECT_EQ(one.changed, two.changed);
    EXPECT_EQ(one.rays, two.rays);
}

} // namespace
} // namespace limn::patch_sides_test
