// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/sparse_probes/receivers.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// What a relight ray meets where it meets no receiver.
inline constexpr std::uint32_t kSkyHit = ~0U;      ///< nothing: the sky
inline constexpr std::uint32_t kDarkHit = ~0U - 1; ///< the back of a one-sided surface

/// The `count` directions of every probe's relight rays, evenly spread over the sphere.
std::vector<glm::vec3> relightDirections(std::uint32_t count);

/// Harmonics of the relight directions: bands^2 values Y_lm(d_q) per direction.
std::vector<float> relightBasis(std::span<const glm::vec3> directions, int bands);

/// Traces every probe's relight rays through the static scene. Returns per probe and direction the
/// receiver that is hit, kSkyHit or kDarkHit; incomplete when cancelled.
std::vector<std::uint32_t> traceRelightRays(const TraceScene& trace, const ReceiverAt& receiverAt,
                                            std::span<const glm::vec3> probes,
                                            std::span<const glm::vec3> directions,
                                            const Progress& progress);

} // namespace limn
