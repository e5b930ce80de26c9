// SPDX-License-Identifier: MIT
#pragma once

#include "app/papers/paper_experiments.h"
#include "app/papers/paper_view.h"

#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/relight.h"

#include <memory>
#include <string>
#include <vector>

namespace limn {

// What the experiments on precomputed illuminance composition share.

/// How a bake links: as the paper does, or by the program's defaults. The paper's caches look for
/// every surfel by a ray. With settings 1 that is 1.4 billion rays, whose results would take 26 GiB
/// before they are cut, so that these keep the paper's cut alone and gather.
enum class LinkMode : std::uint8_t { Paper, Limn };
inline constexpr LinkMode kLinkModes[] = {LinkMode::Paper, LinkMode::Limn};

/// Settings 1 of Table 2, as in Figure 8 (g): n_C = 10 585, l = 4, n_L = 254, n_S = 128 k.
BakeSettings paperSettings1(LinkMode mode);
/// Settings 2: l = 3, n_L = 128, n_S = 32 k.
BakeSettings paperSettings2(LinkMode mode);

/// "paper's links" or "Limn's links".
const char* nameOf(LinkMode mode);

/// Bakes the scene, with the run's stages.
Result<std::shared_ptr<const Bake>> bakeFor(PaperRun& run, const FrontScene& front,
                                            const BakeSettings& settings);

/// Statistics of updates of one bounce of all bands on the CPU, each with all lights moved, after
/// one that does not count.
std::vector<RelightStats> relightRuns(const FrontScene& front, std::shared_ptr<const Bake> bake,
                                      int runs);

/// Memory that updates read and write, of the bake and beside it [MiB].
double mebibytesOf(const Bake& bake, const RelightStats& stats);

/// The sample `signs`, and the sample `cornell` with a small spot that lights a patch of its floor.
extern const PaperScene kPaperSigns, kPaperSpot;

Result<void> measureStepTimes(PaperRun& run);   // Table 2
Result<void> measureResolutions(PaperRun& run); // Section 5.3.1
Result<void> measureChrominance(PaperRun& run); // Table 3
Result<void> measureMemory(PaperRun& run);      // Table 4
Result<void> measurePlacements(PaperRun& run);  // Figure 3
Result<void> measureSigns(PaperRun& run);       // Figure 7
Result<void> measureGlossy(PaperRun& run);      // Figure 8
Result<void> measureSpot(PaperRun& run);        // Figure 9 (b)
Result<void> measureCounts(PaperRun& run);      // Figure 10
Result<void> measureBands(PaperRun& run);       // Figure 11

} // namespace limn
