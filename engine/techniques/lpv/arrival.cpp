// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/arrival.h"

#include "engine/math/luminance.h"

#include <utility>

namespace limn {

/// In proportion to the flux that leaves each cell.
static std::vector<float> fluxes(const CellLight& light) {
    const glm::ivec3 size(light.cells.size);
    std::vector<float> flux;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                flux.push_back(luminance(light.lobe({x, y, z})[0]));
    return flux;
}

std::vector<std::uint32_t> arrivalRounds(const CellLight& injected, const FaceBlockers* blockers,
                                         std::uint32_t rounds) {
    const std::vector<float> whole = fluxes(propagate(injected, blockers, rounds));
    std::vector<float> sum(whole.size());
    std::vector<std::uint32_t> arrival(whole.size(), kNeverLit);
    CellLight from = injected, to(injected.cells.size);
    for (std::uint32_t round = 0; round <= rounds; ++round) {
        const std::vector<float> flux = fluxes(from);
        for (std::size_t c = 0; c < sum.size(); ++c) {
            sum[c] += flux[c];
            if (arrival[c] == kNeverLit && sum[c] > 0 && sum[c] >= kArrivedShare * whole[c])
                arrival[c] = round;
        }
        propagateOnce(from, round == 0 ? nullptr : blockers, to);
        std::swap(from, to);
    }
    return arrival;
}

} // namespace limn
