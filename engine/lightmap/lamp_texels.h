// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/fine_blocks.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// nRMSE that all texels together may have by light from lamps.
inline constexpr double kLampError = 0.1;

/// Refines the lookups between whose texels light from lamps varies more than interpolation shows:
/// beside the rim of a lamp, at the edges of its shadows, behind a door ajar.
///
/// A block is added where it removes a squared error larger than its texels may have, if each of
/// the `wanted` texels has an equal share in an nRMSE of kLampError. The error is that of the
/// irradiance by LampLight, relative to its mean over all texels. It is measured twice, with
/// independent samples; the product of both deviations has no bias by their noise.
///
/// `triangles` lie in all lookups of the atlas. Adds at most `maxTexels` texels, those that remove
/// most first, on at most `levels` levels, of which each may use half of what is left. The result
/// must not be used when cancelled.
FineLookups findLampLookups(const TraceScene& trace, const Atlas& atlas,
                            std::vector<PlacedTriangle> triangles, std::uint32_t wanted,
                            std::uint32_t maxTexels, int levels, const Progress& progress);

} // namespace limn
