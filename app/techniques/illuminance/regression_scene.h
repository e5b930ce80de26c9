// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/regression_figures.h"

#include "engine/core/progress.h"
#include "engine/core/result.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace limn {

/// A scene of the regression figures.
struct RegressionScene {
    const char* scene; ///< as openScene() takes it
    const char* name;  ///< in figures
    bool sealed;       ///< its second camera is in a room that no light reaches
};

/// One room under a lamp, a court under the sky and the sun, two rooms of which one is sealed, and
/// two with a door ajar between them.
std::span<const RegressionScene> regressionScenes();

/// Bakes of a scene whose counts differ by less than a per cent, so that surfels, clusters, texels
/// and rays all fall elsewhere. A figure is the mean over them; its noise is the standard error
/// that their spread shows.
inline constexpr std::uint32_t kRegressionTrials = 4;

/// Measures a scene's figures. They depend neither on the number of threads nor on what was
/// measured before. Fails where the scene cannot be opened or baked, and when cancelled.
Result<std::vector<RegressionFigure>> measureRegression(const RegressionScene& scene,
                                                        const Progress& progress);

} // namespace limn
