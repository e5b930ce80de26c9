// SPDX-License-Identifier: MIT
#include "editor_ui/panels/bake_estimate.h"

#include <algorithm>
#include <cmath>

namespace limn {

StageSeconds expectedSeconds(const Bake& before, const BakeSettings& wanted) {
    const double rays = double(wanted.rays) / before.settings.rays;
    const double surfels = double(wanted.surfels) / before.settings.surfels;
    StageSeconds expected = before.seconds;
    for (auto& [stage, seconds] : expected)
        seconds *= stage == "trace" ? rays : stage == "cut" ? std::sqrt(rays) : surfels;
    return expected;
}

double secondsLeft(const StageSeconds& expected, const std::string& stage, double fraction,
                   double stageSeconds) {
    if (expected.empty())
        return -1;
    auto at = std::find_if(expected.begin(), expected.end(),
                           [&](const auto& entry) { return entry.first == stage; });
    if (at == expected.end())
        return std::max(0.0, expected.back().second - stageSeconds);
    double left = std::max(0.0, at->second - stageSeconds);
    // An earlier estimate of the pace would fluctuate.
    if (fraction > 0.05 && stageSeconds > 0.2)
        left = stageSeconds * (1 - fraction) / fraction;
    for (auto later = at + 1; later != expected.end(); ++later)
        left += later->second;
    return left;
}

BakeSettings previewSettings(BakeSettings settings) {
    settings.rays = std::min(settings.rays, 64U);
    settings.links = std::min(settings.links, 32U);
    settings.surfels = std::min(settings.surfels, 8192U);
    return settings;
}

} // namespace limn
