// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/format/sky_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limn {

static_assert(kSkyBands * kSkySectors == kSkyCells);

std::uint32_t skyCellOf(glm::vec3 d) {
    const float turn = std::atan2(d.z, d.x) / (2 * std::numbers::pi_v<float>)+0.5f;
    const float height = (d.y + 1) / 2; // equal heights are equal solid angles
    const auto cell = [](float x, std::uint32_t n) {
        return std::min(std::uint32_t(std::max(x, 0.f) * float(n)), n - 1);
    };
    return cell(height, kSkyBands) * kSkySectors + cell(turn, kSkySectors);
}

glm::vec3 skyCellDirection(std::uint32_t cell) {
    const float height = (float(cell / kSkySectors) + 0.5f) / kSkyBands * 2 - 1;
    const float angle =
        ((float(cell % kSkySectors) + 0.5f) / kSkySectors - 0.5f) * 2 * std::numbers::pi_v<float>;
    const float r = std::sqrt(1 - height * height);
    return {r * std::cos(angle), height, r * std::sin(angle)};
}

std::vector<bool> skyNodes(const ClusterTree& tree) {
    std::vector<bool> sky(tree.size());
    for (std::uint32_t i = tree.surfels; i < tree.leaves(); ++i)
        sky[i] = true;
    for (std::uint32_t k = 0; k < tree.left.size(); ++k)
        sky[tree.leaves() + k] = sky[tree.left[k]] && sky[tree.right[k]];
    return sky;
}

} // namespace limn
