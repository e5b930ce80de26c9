// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/cut/rooms.h"

#include "engine/techniques/illuminance/bake/senders/cluster_tree.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace limn {

namespace {

constexpr std::uint32_t kTracedLamps = TracedTraining::kLamps;
constexpr std::uint32_t kNone = ~0U;

/// One bit per lamp that lights the surfel.
std::vector<std::uint32_t> lampsOf(const TracedTraining& traced) {
    static_assert(kTracedLamps <= 32);
    std::vector<std::uint32_t> result(traced.position.size());
    for (std::size_t s = 0; s < result.size(); ++s)
        for (std::uint32_t k = 0; k < kTracedLamps; ++k)
            result[s] |= std::uint32_t(traced.lamp(s, k) > 0) << k;
    return result;
}

/// Per lamp, the lowest-numbered lamp of its room.
std::array<std::uint32_t, kTracedLamps> joinLamps(const std::vector<std::uint32_t>& lamps) {
    std::array<std::array<std::uint32_t, kTracedLamps>, kTracedLamps> both{};
    for (const std::uint32_t lit : lamps)
        for (std::uint32_t a = 0; a < kTracedLamps; ++a)
            for (std::uint32_t b = 0; lit >> a & 1 && b <= a; ++b)
                both[a][b] += lit >> b & 1;
    std::array<std::uint32_t, kTracedLamps> room;
    std::iota(room.begin(), room.end(), 0U);
    for (std::uint32_t a = 0; a < kTracedLamps; ++a)
        for (std::uint32_t b = 0; b < a; ++b)
            if (both[a][b] > 0 && 2 * both[a][b] >= std::min(both[a][a], both[b][b]))
                std::ranges::replace(room, std::max(room[a], room[b]), std::min(room[a], room[b]));
    return room;
}

/// Appends to `out` the subtree of `tree` that is induced by the leaves for which in(leaf) holds;
/// returns its root, or kNone where there are no such leaves.
template <class In>
std::uint32_t addInducedTree(const ClusterTree& tree, In in, ClusterTree& out) {
    std::vector<std::uint32_t> root(tree.size(), kNone);
    for (std::uint32_t leaf = 0; leaf < tree.leaves(); ++leaf)
        root[leaf] = in(leaf) ? leaf : kNone;
    for (std::uint32_t k = 0; k < tree.left.size(); ++k) {
        const std::uint32_t l = root[tree.left[k]], r = root[tree.right[k]];
        std::uint32_t& to = root[tree.leaves() + k];
        if (l == kNone || r == kNone) {
            to = l == kNone ? r : l;
            continue;
        }
        to = out.size();
        out.left.push_back(l);
        out.right.push_back(r);
    }
    return root.back();
}

} // namespace

std::vector<std::uint32_t> findRooms(const TracedTraining& traced) {
    const std::vector<std::uint32_t> lamps = lampsOf(traced);
    const std::array<std::uint32_t, kTracedLamps> roomOf = joinLamps(lamps);
    std::vector<std::uint32_t> result(lamps.size(), kTracedLamps);
    for (std::size_t s = 0; s < result.size(); ++s) {
        std::array<float, kTracedLamps> light{};
        for (std::uint32_t k = 0; k < kTracedLamps; ++k)
            light[roomOf[k]] += traced.lamp(s, k);
        const auto brightest = std::ranges::max_element(light);
        if (*brightest > 0)
            result[s] = std::uint32_t(brightest - light.begin());
    }
    std::array<std::uint32_t, kTracedLamps + 1> number;
    number.fill(kNone);
    std::uint32_t rooms = 0;
    for (std::uint32_t& r : result) {
        if (number[r] == kNone)
            number[r] = rooms++;
        r = number[r];
    }
    return result;
}

ClusterTree splitByRoom(const ClusterTree& tree, const Surfels& surfels,
                        const std::vector<std::uint32_t>& room) {
    const std::uint32_t rooms = room.empty() ? 0 : *std::ranges::max_element(room) + 1;
    if (rooms < 2)
        return tree;
    ClusterTree out;
    out.surfels = tree.surfels;
    out.skyCells = tree.skyCells;
    out.skyDirection = tree.skyDirection;
    std::uint32_t top = kNone;
    const auto join = [&](std::uint32_t root) {
        if (root != kNone && top != kNone) {
            out.left.push_back(top);
            out.right.push_back(root);
            root = out.size() - 1;
        }
        top = root == kNone ? top : root;
    };
    std::vector<std::uint32_t> roots;
    for (std::uint32_t r = 0; r < rooms; ++r)
        roots.push_back(addInducedTree(
            tree, [&](std::uint32_t leaf) { return leaf < tree.surfels && room[leaf] == r; }, out));
    const std::uint32_t sky = addInducedTree(
        tree, [&](std::uint32_t leaf) { return leaf >= tree.surfels; }, out);
    for (const std::uint32_t root : roots)
        join(root);
    join(sky);
    fillWeightsAndParents(surfels, out);
    return out;
}

} // namespace limn
