// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/probe_grid.h"

#include <algorithm>
#include <cmath>

namespace limn {

/// The grid with steps of about `step`.
static ProbeGrid gridOf(Bounds bounds, float step) {
    ProbeGrid grid{bounds, glm::uvec3(0)};
    for (int a = 0; a < 3; ++a) {
        const float extent = bounds.size()[a];
        if (extent < step) {
            const float middle = bounds.centre()[a];
            grid.bounds.lower[a] = middle - step;
            grid.bounds.upper[a] = middle + step;
            grid.size[a] = 2;
        } else {
            grid.size[a] = std::uint32_t(std::lround(extent / step));
        }
    }
    return grid;
}

ProbeGrid chooseProbes(const Bounds& bounds, std::uint32_t wanted) {
    const glm::vec3 size = bounds.size();
    const float longest = std::max({size.x, size.y, size.z});
    if (!(longest > 0) || !std::isfinite(longest))
        return {};
    // The number of probes falls as the step grows; the finest grid of at most as many as wanted.
    float fine = longest / float(std::max(wanted, 2U)), coarse = 2 * longest;
    for (int i = 0; i < 40; ++i) {
        const float step = std::sqrt(fine * coarse);
        const glm::dvec3 n(gridOf(bounds, step).size);
        (n.x * n.y * n.z > double(wanted) ? fine : coarse) = step;
    }
    return gridOf(bounds, coarse);
}

} // namespace limn
