// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_repairs.h"

#include <fmt/format.h>

namespace limn {

void GltfRepairs::merge(const GltfRepairs& other) {
    for (const auto& [what, count] : other.counts)
        counts[what] += count;
    sentences.insert(sentences.end(), other.sentences.begin(), other.sentences.end());
}

std::vector<std::string> GltfRepairs::lines() const {
    std::vector<std::string> lines;
    for (const auto& [what, count] : counts)
        lines.push_back(fmt::format("{} {}", count, what));
    lines.insert(lines.end(), sentences.begin(), sentences.end());
    return lines;
}

} // namespace limn
