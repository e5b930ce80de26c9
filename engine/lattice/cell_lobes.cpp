// SPDX-License-Identifier: MIT
#include "engine/lattice/cell_lobes.h"

#include <algorithm>
#include <numeric>

namespace limn {

/// The samples' numbers in the order of their cells, those of a cell in their own order.
static std::vector<std::uint32_t> orderByCell(std::span<const LobeSample> samples,
                                              std::size_t cells) {
    std::vector<std::uint32_t> order(samples.size());
    if (samples.size() * 16 < cells) { // counting would take longer than sorting
        std::iota(order.begin(), order.end(), 0U);
        std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return samples[i].cell; });
        return order;
    }
    std::vector<std::uint32_t> next(cells + 1, 0);
    for (const LobeSample& sample : samples)
        ++next[sample.cell + 1];
    for (std::size_t c = 0; c < cells; ++c)
        next[c + 1] += next[c];
    for (std::uint32_t i = 0; i < samples.size(); ++i)
        order[next[samples[i].cell]++] = i;
    return order;
}

std::vector<CellLobe> sumByCell(std::span<const LobeSample> samples, std::size_t cells) {
    const std::vector<std::uint32_t> order = orderByCell(samples, cells);
    std::vector<CellLobe> sums;
    for (std::size_t k = 0; k < order.size();) {
        const std::uint32_t c = samples[order[k]].cell;
        std::array<glm::dvec3, 4> sum{};
        for (; k < order.size() && samples[order[k]].cell == c; ++k) {
            const LobeSample& s = samples[order[k]];
            const glm::dvec3 weight(s.weight), slope = weight * double(kCosineSlope);
            sum[0] += weight * double(kCosineMean);
            sum[1] += slope * double(s.normal.y);
            sum[2] += slope * double(s.normal.z);
            sum[3] += slope * double(s.normal.x);
        }
        CellLobe& cell = sums.emplace_back(CellLobe{.cell = c});
        for (std::size_t i = 0; i < sum.size(); ++i)
            cell.lobe[i] = glm::vec3(sum[i]);
    }
    return sums;
}

} // namespace limn
