// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lighting/lighting.h"

#include <vector>

namespace limn {

/// The lights as placed in run k: a directional light turns a little, any other moves a little.
std::vector<Light> movedLights(std::vector<Light> lights, int k);

/// The scene with its lights moved as in run k, or its sky changed where it has no lights.
Scene withMovedLights(const Scene& scene, int k);

/// Reports of `runs` updates of one bounce, each with all lights moved, after a first one that also
/// lights the materials. `lighting` is fresh; `trace` belongs to `scene`. Empty when cancelled.
std::vector<LightingReport> updatesWithMovedLights(Lighting& lighting, const Scene& scene,
                                                   const TraceScene& trace, int runs,
                                                   const Progress& progress = {});

/// Of updatesWithMovedLights(), the one that took least time. Other work on the machine only ever
/// adds time. A cancelled call returns no steps.
LightingReport fastestUpdate(Lighting& lighting, const Scene& scene, const TraceScene& trace,
                             int runs, const Progress& progress = {});

} // namespace limn
