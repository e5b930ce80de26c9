// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace limn {

/// Union-find: sets that are joined pairwise and identified by their smallest member.
struct DisjointSets {
    std::vector<std::uint32_t> parent;

    explicit DisjointSets(std::size_t count) : parent(count) {
        std::iota(parent.begin(), parent.end(), 0U);
    }
    std::uint32_t find(std::uint32_t i) {
        while (parent[i] != i)
            i = parent[i] = parent[parent[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a), b = find(b);
        parent[std::max(a, b)] = std::min(a, b);
    }
};

} // namespace limn
