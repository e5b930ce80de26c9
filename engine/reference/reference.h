// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/scene/view.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>

namespace limn {

struct ReferenceOptions {
    View view = View::Lit; ///< Lit, Direct, Indirect, Irradiance; all surfaces Lambertian
    Camera camera;
    std::uint32_t width = 512, height = 512;
    std::uint32_t samplesPerPixel = 256;
    std::uint32_t maxBounces = 64; ///< path segments after the first surface
    std::uint32_t seed = 1;
};

struct ReferenceResult {
    ImageF image;          ///< linear
    double noise = 0;      ///< standard error of the pixel means: rms over pixels / mean of the image
    std::uint32_t samplesPerPixel = 0; ///< done; fewer than asked when cancelled
    std::uint64_t rays = 0;
};

/// Path-traced ground truth. Same bytes at any number of threads. A cancelled call returns what it has.
ReferenceResult renderReference(const TraceScene& trace, const ReferenceOptions& options, const Progress& progress = {});

/// Irradiance [W m^-2] at one surface point: direct lights excluded (`indirect` of View) unless `includeDirect`.
glm::vec3 referenceIrradiance(const TraceScene& trace, glm::vec3 position, glm::vec3 normal, std::uint32_t samples,
                              std::uint32_t maxBounces, bool includeDirect, std::uint32_t seed);

} // namespace limn
