// SPDX-License-Identifier: MIT
#pragma once

#include "engine/trace/trace_scene.h"

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Maximum number of transmissive surfaces that an eye's ray crosses or is reflected within.
inline constexpr std::uint32_t kMaxCrossings = 16;

/// Whether the ray met the surface of a transmissive body from within, where nothing is reflected
/// or emitted but what passRay() follows.
bool isWithinBody(const Scene& scene, const Hit& hit);

/// How an eye's ray goes on at a transmissive surface.
struct PassedRay {
    Ray ray;
    glm::vec3 weight{0}; ///< share of the radiance along `ray` that reaches the eye; 0: none does
};

/// The ray that goes on behind the surface that `ray` has met with `hit`: straight on through a
/// thin sheet, bent by Snell's law at the surface of a body. From outside, the weight is the
/// transmitted share, and what the surface mirrors is left to the caller. From within a body,
/// `pick` in [0, 1) selects whether the ray leaves it or is mirrored. `facet` in [0, 1)^2 selects
/// the facet of a rough surface. Light is bent and mirrored about the interpolated normals; what
/// would end up on the wrong side of the triangle is lost. The weight is 0 at surfaces that
/// transmit nothing.
PassedRay passRay(const TraceScene& trace, const Hit& hit, const Ray& ray, float pick,
                  glm::vec2 facet);

} // namespace limn
