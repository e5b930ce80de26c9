// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/camera.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Surface points for which virtual lights are to matter.
struct ViewSamples {
    std::vector<glm::vec3> position;
    std::vector<glm::vec3> normal; ///< unit, geometric, of the side that is seen

    std::size_t size() const { return position.size(); }
};

/// Rows of pixels of a view of no picture.
inline constexpr float kRowsWithoutSize = 1024;

/// What a view shows at `count` of its pixels, the first points of the Halton sequence in bases 2
/// and 3; fewer where it shows no surface. Ritschel, Eisemann, Ha, Kim, Seidel. Making Imperfect
/// Shadow Maps View-Adaptive. 2011
ViewSamples samplesOfView(const TraceScene& trace, const Scene& scene, const Viewpoint& view,
                          std::uint32_t count);

/// `count` points spread evenly over the area of all surfaces, for light without a view. On
/// two-sided surfaces they lie on both sides in turn.
ViewSamples samplesOfSurfaces(const Scene& scene, std::uint32_t count);

} // namespace limn
