// SPDX-License-Identifier: MIT
#pragma once

#include "app/bench/leak_room.h"
#include "app/bench/light_place.h"
#include "app/bench/measured_scene.h"
#include "app/bench/settings_sweep.h"
#include "app/bench/techniques_page.h"

#include "engine/core/result.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace limn {

struct SceneBenchOptions {
    std::vector<std::string> techniques; ///< names; empty: all
    SettingsSweep varied;                ///< of the techniques, for variantsOf()
    int runs = 9;                        ///< maximum number of updates of each kind
    /// Time for all techniques [s]; none: no limit. Settings that do not fit are skipped, and the
    /// coarse ones of all techniques come first.
    std::optional<double> seconds;
    std::function<void(const Json& row)> show; ///< called with each row at once
};

/// Measures the techniques in all places that can light them. Says on stderr what is being measured
/// and what is skipped, because it takes too long or the device is too small; the page's note says
/// the latter too. Fails where a technique cannot precompute its data, though there was time.
Result<PageScene> benchScene(const SceneBenchOptions& options, const LeakRoom& room,
                             const std::vector<LightPlace>& places, const MeasuredScene& scene);

} // namespace limn
