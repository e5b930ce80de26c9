// SPDX-License-Identifier: MIT
#include "engine/lattice/cell_lobes.h"

namespace limn {

std::vector<CellLobe> sumByCell(std::span<const LobeSample> samples, std::size_t cells) {
    std::vector<std::uint32_t> begin(cells + 1, 0);
    for (const LobeSample& sample : samples)
        ++begin[sample.cell + 1];
    for (std::size_t c = 0; c < cells; ++c)
        begin[c + 1] += begin[c];
    std::vector<std::uint32_t> order(samples.size()), next(begin.begin(), begin.end() - 1);
    for (std::uint32_t i = 0; i < samples.size(); ++i)
        order[next[samples[i].cell]++] = i;
    std::vector<CellLobe> sums;
    for (std::uint32_t c = 0; c < cells; ++c) {
        if (begin[c] == begin[c + 1])
            continue;
        std::array<glm::dvec3, 4> sum{};
        for (std::uint32_t k = begin[c]; k < begin[c + 1]; ++k) {
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
