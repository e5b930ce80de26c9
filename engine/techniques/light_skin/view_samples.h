// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/camera.h"
#include "engine/techniques/light_skin/light_caches.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Surface points for which virtual lights are to matter.
struct ViewSamples {
    std::vector<glm::vec3> position;
    std::vector<glm::vec3> normal; ///< unit, geometric, of the side that is seen

    std::size_t size() const { return position.size(); }
};

/// Pixels in which samples are found: those of the view's picture, or 1024 rows where it has none.
glm::uvec2 sampledPixels(const Viewpoint& view);

/// What a view shows at `count` of its pixels, the first points of the Halton sequence in bases 2
/// and 3; fewer where it shows no surface. Ritschel, Eisemann, Ha, Kim, Seidel. Making Imperfect
/// Shadow Maps View-Adaptive. 2011
ViewSamples samplesOfView(const TraceScene& trace, const Scene& scene, const Viewpoint& view,
                          std::uint32_t count);

/// Caches that face the eye and lie within the picture of a view, with the pixels in which they
/// lie. What is before them may hide them.
struct CachesInView {
    ViewSamples caches;
    std::vector<glm::uvec2> pixel;
    float near = 0; ///< distance within which a cache's own surface lies [m]

    std::size_t size() const { return pixel.size(); }
};
CachesInView cachesInView(const LightCaches& caches, const Viewpoint& view);

/// Share of CachesInView::near by which the surface that a pixel shows may pass a cache that is
/// seen.
inline constexpr float kSeenShare = 0.125f;

/// Those of the caches that the view shows: the middle of their pixel is on a surface that is near,
/// and whose plane passes them by no more than kSeenShare of that.
ViewSamples seenCaches(const TraceScene& trace, const Scene& scene, const CachesInView& candidates,
                       const Viewpoint& view);

/// `count` points spread evenly over the area of all surfaces, for light without a view. On
/// two-sided surfaces they lie on both sides in turn.
ViewSamples samplesOfSurfaces(const Scene& scene, std::uint32_t count);

} // namespace limn
