// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/relight.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Light [W m^-2, W m^-2 sr^-1] that costs as much as any other and lies many orders of magnitude
/// below the last bit of light at work. Added to light of more than 1e-12, it changes no bit but,
/// in a few surfels, the last one: perhaps where a fused multiply-add sees it before it rounds a
/// tie.
inline constexpr float kFaintLight = 1e-20f;

/// A scene that lacks something, so that an update of its light can skip work, and how the same
/// light is computed with all of that work.
struct LackingScene {
    const char* lacks;   ///< in the table
    const char* counter; ///< name of what `count` counts
    /// Counts what an update skipped. `whole`: the same update with all the work.
    std::uint64_t (*count)(const RelightStats& skipping, const RelightStats& whole);

    Scene scene;        ///< without the thing
    Scene whole;        ///< with it, but faint, where that is what makes the work; else `scene`
    bool faint = false; ///< `whole` has faint light more
    bool unreadLinks = false;  ///< `count` counts links whose memory is not read
    bool allBands = false;     ///< the whole work lights all bands of the bake
    bool unreadGrid = false;   ///< the whole work lights the grid that nothing reads
    bool still = false;        ///< nothing moves; the whole work starts from nothing at each update
    bool looksAtTenth = false; ///< the camera sees a tenth of the caches; the whole work lights all
};

/// The variants of `scene` that lack something; what it cannot lack is left out: objects that read
/// the grid. `bake`: of `scene`. A scene without lights gets a lamp, which can move.
std::vector<LackingScene> lackingScenes(const Scene& scene, const Bake& bake);

} // namespace limn
