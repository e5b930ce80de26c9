// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/cut/training_light.h"
#include "engine/techniques/illuminance/bake/cut/visible_tree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace limn {

/// A value for each training lighting.
using LightingRow = std::array<float, TrainingLight::kCount>;

/// Radiosities as one cache receives them: formFactor * radiosity[t], with a radiosity per
/// lighting.
struct Received {
    float formFactor;
    const float* radiosity;
};

/// What senders contribute to a cache in each lighting: the sum over `node` of the node's
/// radiosity, times the irradiance of its `formFactor`. Both spans have the same length.
LightingRow receivedFrom(const TrainingLight& training, std::span<const std::uint32_t> node,
                         std::span<const FormFactor> formFactor);

/// Number of nodes whose radiosity a link to two senders might read.
inline constexpr std::size_t kLinkCandidates = 3;

/// Errors of one link in place of two senders. Writes the irradiance that the two contribute in
/// each lighting to `contribution`. A link that reads a candidate contributes `formFactor` times
/// its radiosity instead: returns the mean square of the difference over the lightings, each times
/// its `weight`. The result has the same bits on every vector unit.
std::array<float, kLinkCandidates>
linkErrors(const Received& left, const Received& right, float formFactor,
           const std::array<const float*, kLinkCandidates>& candidates, const float* weight,
           float* contribution);

} // namespace limn
