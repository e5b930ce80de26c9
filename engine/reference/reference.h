// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/reference/path.h"
#include "engine/scene/view.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>

namespace limn {

struct ReferenceOptions {
    View view = View::Lit; ///< Lit, Direct, Indirect, Irradiance, Albedo
    Camera camera;
    std::uint32_t width = 512, height = 512;
    std::uint32_t samplesPerPixel = 256;
    std::uint32_t maxBounces =
        kMaxBounces; ///< path segments after the first surface; longer paths are cut
    std::uint32_t seed = 1;
    /// In Lit: whether surfaces that the eye sees, but not through glass, show the bounced light
    /// that they reflect diffusely.
    bool showsDiffuseBounces = true;
    /// What casts the shadows of lamps at the first surface. Light tracing adds what passes sheets.
    TraceMask lampShadows = TraceMask::All;
};

struct ReferenceResult {
    ImageF image; ///< linear
    /// Standard error of the pixel means: rms over pixels and channels / mean of the image, from
    /// two independently scrambled halves of the samples. It is infinite below 2 samples.
    double noise = 0;
    std::uint32_t samplesPerPixel = 0; ///< number computed; fewer than requested when cancelled
    std::uint64_t rays = 0;
};

/// Path-traced ground truth. Every surface is Lambertian with surfaceMaterial()'s albedo; in Lit
/// the first one is also glossy and reflects all light by specularBrdf(), and where it transmits
/// light, the eye looks through it (passRay()). To paths, sheets of it are absent (isGlassSheet())
/// and bodies opaque. Cosines are those of the interpolated vertex normals, bent by normal maps;
/// the triangle itself bounds the visible hemisphere. The back of a one-sided surface is black, to
/// the camera and to paths, and blocks light. Emission leaves the front only, unless the material
/// is double-sided. Nothing is clamped and fireflies are not removed. Surface points, direct light,
/// emitters and the sky are those of engine/shading, which pictures use as well; tests/reference
/// holds them to closed forms. The pixel filter is a box. The result is identical for any number of
/// threads. A cancelled call returns the samples so far.
ReferenceResult renderReference(const TraceScene& trace, const ReferenceOptions& options,
                                const Progress& progress = {});

/// Irradiance [W m^-2] at one surface point, without direct light (`indirect` of View) unless
/// `includeDirect`. Thread-safe; its samples are also distributed over threads.
glm::vec3 referenceIrradiance(const TraceScene& trace, glm::vec3 position, glm::vec3 normal,
                              std::uint32_t samples, std::uint32_t maxBounces, bool includeDirect,
                              std::uint32_t seed);

} // namespace limn
