// SPDX-License-Identifier: MIT
#include "engine/picture/gather_stages.h"

#include <algorithm>
#include <cmath>

namespace limn {

/// A first stage with a standard error of this part of the mean light is doubled; the second one is
/// at most kMaxSecondStage times as large.
static constexpr double kErrorToDouble = 0.125, kMaxSecondStage = 255;

/// Rays of a pixel's second stage; fewer are not worth taking.
static constexpr std::uint32_t kMinRays = 16;

std::uint32_t secondStageCount(const GatherStages& stages, double variance) {
    if (!(stages.meanLight > 0))
        return 0;
    const std::uint32_t count = stages.firstCount;
    const double times = std::sqrt(variance / count) / (kErrorToDouble * stages.meanLight);
    const auto second = std::uint32_t(std::min(times, kMaxSecondStage) * count);
    return second * stages.raysPerSample < kMinRays ? 0 : second;
}

} // namespace limn
