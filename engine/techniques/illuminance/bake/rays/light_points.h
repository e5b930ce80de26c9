// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/illuminance/bake/rays/gather.h"
#include "engine/techniques/illuminance/format/bake.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Number of points of a surfel among which its light points are chosen.
inline constexpr std::uint32_t kLightCandidates = 4 * kLightPoints;

struct LightPoints {
    std::vector<glm::vec3> position, normal; ///< Surfels::lightPoints and lightNormals
    std::uint64_t rays = 0;                  ///< number of rays traced
};

/// Finds where direct light falls on each surfel: at points that rays of caches met on its patch,
/// chosen with probability in proportion to what they contribute to the caches. The mean over them
/// is an unbiased estimate of the direct light that the caches see on the patch. A mean over the
/// patch's area is not what they see: half of them may look at the shaded strip under a moulding
/// that covers a tenth of it. Points that a wall separates from the surfel's place do not count; a
/// surfel without others has its place alone.
///
/// kLightCandidates of the rays are chosen by systematic sampling and traced again, since
/// GatherHits stores no positions. Their points are sorted along a Morton curve, and a random one
/// is taken of every four in turn (stratified sampling), so that an edge of a shadow adds little
/// noise. `hits`: from traceHits(); `surfels` with the triangles' normals. Meaningless when
/// cancelled.
LightPoints findLightPoints(const TraceScene& trace, const Surfels& surfels,
                            const RayGatherer& gatherer, const Caches& caches,
                            const CachePoints& points, const GatherHits& hits,
                            const Progress& progress);

} // namespace limn
