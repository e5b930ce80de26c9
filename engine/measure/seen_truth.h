// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"
#include "engine/measure/compare.h"
#include "engine/measure/seen_points.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace limn {

/// How fine a truth is.
struct TruthSize {
    std::uint32_t width = 96, height = 54; ///< numbers of points across and down
    std::uint32_t paths = 64;              ///< number for a point, in each of two references
};

/// What light at visible points is, path-traced: direct irradiance, and irradiance with all
/// bounces, estimated twice by independent paths [W m^-2]. The images have one row.
struct SeenTruth {
    std::vector<SeenPoint> points;
    ImageF direct, first, second;

    bool isDark() const;
};

/// Traces the truth; std::nullopt when cancelled.
std::optional<SeenTruth> findSeenTruth(const TraceScene& trace, const Camera& camera,
                                       const TruthSize& size, const Progress& progress = {});

/// Error of light that is up to date with the scene of `trace`.
Result<Comparison> compareWithTruth(const TraceScene& trace, const Lighting& lighting,
                                    const LightmapLayout& layout, const SeenTruth& truth);

} // namespace limn
