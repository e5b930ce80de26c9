// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting.h"

#include <functional>
#include <optional>

namespace limn {

/// How updates are repeated: their median counts.
struct UpdateRuns {
    int maxRuns = 9;
    double enoughMs = 4000; ///< updates of one kind end when they have taken this long
};

/// Median times of updates [ms], as LightingReport::totalMs. Drawing the shadow maps of a device,
/// which happens before the update, does not count.
struct UpdateTimes {
    double light = 0;             ///< all lights moved; without lights, sky and emission changed
    std::optional<double> color;  ///< colours of all lights; none: there are none
    double material = 0;          ///< albedo of the first material
    std::optional<double> object; ///< all dynamic objects moved; none: there are none
    double camera = 0;            ///< the camera has turned by a third of its field of view
};

/// Measures updates after each kind of change. `lighting` must be up to date with `scene`, and is
/// so again at the end. Updates light the whole scene; those of the turned camera light what
/// `view`, turned, sees.
UpdateTimes timeUpdates(Lighting& lighting, const Scene& scene, const TraceScene& trace,
                        const Viewpoint& view, const UpdateRuns& runs);

} // namespace limn
