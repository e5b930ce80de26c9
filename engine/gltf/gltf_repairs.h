// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace limn {

/// Collects the repairs of an import, counted by kind.
struct GltfRepairs {
    std::map<std::string, std::uint64_t> counts; ///< keyed by the sentence without its number
    std::vector<std::string> sentences;          ///< complete sentences

    /// `add("triangles of zero area removed", 3)` becomes "3 triangles of zero area removed".
    void add(std::string_view what, std::uint64_t count = 1) {
        if (count > 0)
            counts[std::string(what)] += count;
    }
    void merge(const GltfRepairs& other);
    std::vector<std::string> lines() const;
};

} // namespace limn
