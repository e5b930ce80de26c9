// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/gpu/viewport_relighter.h"
#include "engine/techniques/illuminance/relight/relight_choice.h"
#include "engine/trace/trace_scene.h"

namespace limn {

/// Times one update of one bounce on the CPU and on the viewport's device, with every light moved:
/// the median of three, after one that warms up. `trace` is of `scene`, `relighter` of the bake in
/// use and `viewport` shows the scene; it is left with other lights and the relighter's field.
RelightTimes measureRelight(Viewport& viewport, ViewportRelighter& relighter, const Scene& scene,
                            const TraceScene& trace);

} // namespace limn
