// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/gpu/viewport_relighter.h"
#include "engine/techniques/illuminance/relight/relight_choice.h"
#include "engine/trace/trace_scene.h"

namespace limn {

/// Measures one update of one bounce on the CPU and on the viewport's device with every light
/// moved: the median of three updates after a warm-up. `trace` belongs to `scene` and `relighter`
/// to the bake in use. `viewport` shows the scene; it is left with other lights and the relighter's
/// field.
RelightTimes measureRelight(Viewport& viewport, ViewportRelighter& relighter, const Scene& scene,
                            const TraceScene& trace);

} // namespace limn
