// SPDX-License-Identifier: MIT
#pragma once

#include "engine/overlay/overlay_data.h"
#include "engine/scene/scene.h"
#include "engine/techniques/probes/probe_maps.h"

#include <cstdint>

namespace limn {

// How surfaces use a probe, shown on what it and the probes around it see. `scene` is the one of
// the maps; `probe` is below their count.

/// The probe's share of the irradiance of the surfaces that it lights: its weight among the eight.
OverlayData probeWeightOverlay(const ProbeMaps& maps, const Scene& scene, std::uint32_t probe);

/// The share of these surfaces that the probe sees, by its moments alone: GridMoments' bound.
OverlayData probeVisibilityOverlay(const ProbeMaps& maps, const Scene& scene, std::uint32_t probe);

/// How marched reflections end that start where the probe looks and reflect what it sees there,
/// with the paths of some.
OverlayData probeMarchOverlay(const ProbeMaps& maps, const Scene& scene, std::uint32_t probe);

} // namespace limn
