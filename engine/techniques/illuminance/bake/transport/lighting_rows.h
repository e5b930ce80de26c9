// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/transport/training_light.h"
#include "engine/techniques/illuminance/bake/transport/visible_tree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace limn {

/// A value for each training lighting.
using LightingRow = std::array<float, TrainingLight::kCount>;

/// Radiosities as one cache receives them: share * radiosity[t], with a radiosity per lighting.
struct Received {
    float share;
    const float* radiosity;
};

/// What senders bring to a cache in each lighting: the sum over `node` of the node's radiosity,
/// times the irradiance of its `sight`. Both spans have the same length.
LightingRow receivedFrom(const TrainingLight& training, std::span<const std::uint32_t> node,
                         std::span<const Sight> sight);

/// Candidates for the radiosities that one link reads for two senders.
inline constexpr std::size_t kLinkCandidates = 3;

/// Writes what two senders bring together to `brought`, and returns for each candidate the mean
/// square of what it differs from `share` times that candidate, weighted per lighting. The same for
/// all vector units.
std::array<float, kLinkCandidates>
linkErrors(const Received& left, const Received& right, float share,
           const std::array<const float*, kLinkCandidates>& candidates, const float* weight,
           float* brought);

} // namespace limn
