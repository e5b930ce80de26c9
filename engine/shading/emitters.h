// SPDX-License-Identifier: MIT
#pragma once

#include "engine/shading/surface_point.h"

#include <cstdint>
#include <vector>

namespace limn {

/// An emissive triangle in world space.
struct EmissiveTriangle {
    std::uint32_t instance = 0, triangle = 0;
    glm::vec3 corner{0}, edge1{0}, edge2{0};
    glm::vec3 normal{0}; ///< unit, of the front
    float area = 0;      ///< [m^2]
    bool bothSides = false;
};

/// All emissive triangles, each with a probability proportional to its emitted power.
struct Emitters {
    std::vector<EmissiveTriangle> triangles;
    std::vector<double> cdf;              ///< cdf[i] = probability of triangles 0 ... i; ends at 1
    std::vector<std::uint32_t> firstOf;   ///< per instance: its first emissive triangle; ~0: none
    std::vector<std::uint32_t> emitterOf; ///< from there, per triangle of the mesh: index; ~0: none

    bool empty() const { return triangles.empty(); }
};

Emitters findEmitters(const TraceScene& trace);

/// A sampled point on an emitter, seen from a surface.
struct EmitterSample {
    glm::vec3 position{0};
    glm::vec3 normal{0};        ///< unit, on the visible side
    glm::vec3 radiance{0};      ///< [nits]; 0 behind a one-sided emitter or in a mask's hole
    float pdf = 0;              ///< density as seen from the surface [sr^-1]
    std::uint32_t instance = 0; ///< instance that emits
};
EmitterSample sampleEmitter(const Emitters& emitters, const Scene& scene, glm::vec3 from,
                            float pick, glm::vec2 u);

/// Probability density [sr^-1] with which sampleEmitter(), called with `from`, samples the point of
/// `hit`.
float emitterPdf(const Emitters& emitters, const Hit& hit, glm::vec3 from);

} // namespace limn
