// SPDX-License-Identifier: MIT
#pragma once

#include "engine/trace/trace_scene.h"

#include <glm/geometric.hpp>

namespace limn {

/// Whether nothing static blocks the segment between two points above a surface, except the surface
/// itself, which may curve between them: hits for which isIgnored(hit) is true do not count.
template <class Predicate>
bool clearAlong(const TraceScene& trace, glm::vec3 from, glm::vec3 to, Predicate isIgnored) {
    constexpr int kMaxCrossings = 4; ///< maximum number of times that a segment crosses the surface
    const glm::vec3 way = to - from;
    const float distance = glm::length(way);
    if (!(distance > 0))
        return true;
    Ray ray{from, way / distance, 0, distance};
    for (int i = 0; i < kMaxCrossings && ray.tNear < distance; ++i) {
        const Hit hit = trace.closestHit(ray, TraceMask::Static);
        if (!hit)
            return true;
        if (!isIgnored(hit))
            return false;
        ray.tNear = hit.t + trace.epsilonAt(hit.position);
    }
    return true;
}

} // namespace limn
