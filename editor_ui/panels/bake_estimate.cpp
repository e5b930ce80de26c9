// SPDX-License-Identifier: MIT
#include "editor_ui/panels/bake_estimate.h"

#include <algorithm>

namespace limn {

double secondsLeft(const StageSeconds& expected, const std::string& stage, double fraction,
                   double stageSeconds) {
    if (expected.empty())
        return -1;
    auto current = std::find_if(expected.begin(), expected.end(),
                                [&](const auto& entry) { return entry.first == stage; });
    const double atLeast = stageSeconds / 4;
    if (current == expected.end())
        return std::max(atLeast, expected.back().second - stageSeconds);
    double left = std::max(atLeast, current->second - stageSeconds);
    // An earlier estimate of the pace would fluctuate.
    if (fraction > 0.05 && stageSeconds > 0.2)
        left = stageSeconds * (1 - fraction) / fraction;
    for (auto later = current + 1; later != expected.end(); ++later)
        left += later->second;
    return left;
}

} // namespace limn
