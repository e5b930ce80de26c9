// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/illuminance/bake/bake.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

struct LightPoints {
    std::vector<glm::vec3> at; ///< Surfels::lightPoints
    std::uint64_t rays = 0;    ///< number of rays traced
};

/// Finds points spread over the disc around a surfel that has its area, where they lie on the
/// surface of its instance and nothing separates them from its middle; its middle otherwise.
/// `surfels` must have the triangles' normals. Meaningless when cancelled.
LightPoints findLightPoints(const TraceScene& trace, const Surfels& surfels,
                            const Progress& progress);

} // namespace limn
