// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/cut/rooms.h"

#include "engine/techniques/illuminance/bake/senders/cluster_tree.h"
#include "engine/techniques/illuminance/bake/senders/surfels.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace limn::rooms_test {
namespace {

using namespace simple;

/// One room of 8 x 3 x 4 m, or two sealed ones of half of that, which touch nowhere.
Scene rooms(bool two) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    if (two) {
        b.add(box(glm::vec3(0), glm::vec3(4, 3, 4), true));
        b.add(box(glm::vec3(4.1f, 0, 0), glm::vec3(8.1f, 3, 4), true));
    } else
        b.add(box(glm::vec3(0), glm::vec3(8, 3, 4), true));
    return b.build();
}

std::vector<std::uint32_t> roomsOf(const Scene& scene, const SurfelSet& set) {
    const TraceScene trace(scene);
    return findRooms(traceTraining(trace, set.surfels, nullptr, {}));
}

TEST(Rooms, TwoSealedOnesAreTwo) {
    const Scene scene = rooms(true);
    const SurfelSet set = placeSurfels(scene, 2000);
    const std::vector<std::uint32_t> room = roomsOf(scene, set);
    ASSERT_EQ(room.size(), set.surfels.size());
    EXPECT_EQ(std::set(room.begin(), room.end()), (std::set<std::uint32_t>{0, 1}));
    for (std::size_t s = 0; s < room.size(); ++s)
        EXPECT_EQ(room[s] == room[0], set.surfels.position[s].x < 4.05f) << s;
}

TEST(Rooms, AnOpenHallIsOne) {
    const Scene scene = rooms(false);
    const SurfelSet set = placeSurfels(scene, 2000);
    EXPECT_EQ(roomsOf(scene, set), std::vector<std::uint32_t>(set.surfels.size(), 0));
    const ClusterTree tree = buildClusterTree(scene, set);
    EXPECT_EQ(splitByRoom(tree, set.surfels, roomsOf(scene, set)), tree);
}

/// What lies below a node.
struct Below {
    double area = 0;
    std::set<std::uint32_t> rooms; ///< the sky's is ~0
    std::uint32_t leaves = 0;
};

std::vector<Below> belowNodes(const ClusterTree& tree, const Surfels& surfels,
                              const std::vector<std::uint32_t>& room) {
    std::vector<Below> below(tree.size());
    for (std::uint32_t n = 0; n < tree.size(); ++n)
        if (n < tree.surfels)
            below[n] = {double(surfels.area[n]), {room[n]}, 1};
        else if (n < tree.leaves())
            below[n] = {0, {~0U}, 1};
        else {
            const Below &l = below[tree.left[n - tree.leaves()]],
                        &r = below[tree.right[n - tree.leaves()]];
            below[n] = {l.area + r.area, l.rooms, l.leaves + r.leaves};
            below[n].rooms.insert(r.rooms.begin(), r.rooms.end());
        }
    return below;
}

void expectSplit(const ClusterTree& tree, const Surfels& surfels,
                 const std::vector<std::uint32_t>& room, std::uint32_t count) {
    ASSERT_EQ(tree.left.size() + 1, tree.leaves());
    ASSERT_EQ(tree.right.size(), tree.left.size());
    ASSERT_EQ(tree.leftWeight.size(), tree.left.size());
    ASSERT_EQ(tree.parent.size(), tree.size());
    std::vector<int> parents(tree.size());
    for (std::uint32_t k = 0; k < tree.left.size(); ++k)
        for (const std::uint32_t child : {tree.left[k], tree.right[k]}) {
            ASSERT_LT(child, tree.leaves() + k);
            EXPECT_EQ(tree.parent[child], tree.leaves() + k);
            ++parents[child];
        }
    for (std::uint32_t n = 0; n + 1 < tree.size(); ++n)
        EXPECT_EQ(parents[n], 1) << n;
    EXPECT_EQ(tree.parent.back(), ~0U);
    const std::vector<Below> below = belowNodes(tree, surfels, room);
    EXPECT_EQ(below.back().leaves, tree.leaves());
    std::uint32_t mixed = 0;
    for (std::uint32_t k = 0; k < tree.left.size(); ++k) {
        const Below& own = below[tree.leaves() + k];
        const float weight = tree.leftWeight[k];
        EXPECT_GE(weight, 0);
        EXPECT_LE(weight, 1);
        if (!own.rooms.contains(~0U)) {
            EXPECT_NEAR(double(weight) * own.area, below[tree.left[k]].area, 1e-5 * own.area);
        }
        mixed += own.rooms.size() > 1;
    }
    EXPECT_EQ(mixed, count) << "joins of the rooms, and of them and the sky";
}

TEST(Rooms, ATreeSplitByThemKeepsEveryLeafOnce) {
    const Scene scene = rooms(true);
    const SurfelSet set = placeSurfels(scene, 1000);
    const ClusterTree tree = buildClusterTree(scene, set);
    std::vector<std::uint32_t> room = roomsOf(scene, set);
    expectSplit(splitByRoom(tree, set.surfels, room), set.surfels, room, 2);
    std::mt19937 rng(8);
    for (std::uint32_t& r : room) // rooms that have nothing to do with the tree
        r = std::uint32_t(rng()) % 5;
    const ClusterTree split = splitByRoom(tree, set.surfels, room);
    EXPECT_EQ(split.skyDirection, tree.skyDirection);
    expectSplit(split, set.surfels, room, 5);
}

} // namespace
} // namespace limn::rooms_test
