// SPDX-License-Identifier: MIT
#pragma once

#include "engine/runtime/transport_view.h"

namespace limn::runtime {

/// Whether two lights differ at most in colour, strength and source, so that one's shadows serve
/// the other.
bool sameShape(const limnrt_light& a, const limnrt_light& b);

/// Writes the irradiance at each surfel from a light of the same shape, with colour and strength 1,
/// shadows included: the mean over the surfel's light points. A ray for each point; a rectangle has
/// kRectanglePoints for each surfel, or one for each point if these are more.
void lightShares(const TransportView& view, const limnrt_light& light, float* share);

inline constexpr std::uint32_t kRectanglePoints = 16; ///< from all points of a surfel together
inline constexpr float kMaxIrradiance = 1e28f; ///< per light and colour, so that sums stay finite

} // namespace limn::runtime
