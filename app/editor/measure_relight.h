// SPDX-License-Identifier: MIT
#pragma once

#include "engine/files/relight_choice.h"
#include "engine/lighting/lighting.h"
#include "engine/render/viewport.h"

#include <optional>

namespace limn {

/// Measures one update of one bounce on the CPU and on the viewport's device with every light
/// moved: the median of three updates after a warm-up. `onCpu` is fresh, and `onDevice` lights the
/// same data on `viewport`, which shows the scene; `trace` belongs to `scene`. The viewport is left
/// with other lights and the device's field. Returns std::nullopt if an update found nothing to do,
/// because the technique does not read what moved.
std::optional<RelightTimes> measureRelight(Viewport& viewport, Lighting& onDevice, Lighting& onCpu,
                                           const Scene& scene, const TraceScene& trace);

} // namespace limn
