// SPDX-License-Identifier: MIT
#pragma once

#include "engine/runtime/transport_view.h"
#include "engine/runtime/vectors.h"

namespace limn::runtime {

/// Whether a triangle of the file lies on the ray between 0 and `distance` along unit `direction`.
/// Möller, Trumbore. Fast, Minimum Storage Ray/Triangle Intersection. 1997
bool occluded(const TransportView& view, F4 origin, F4 direction, float distance);

/// Offset along a surface's normal at which a ray misses the surface itself [m].
float rayOffset(const TransportView& view, const float* position);

} // namespace limn::runtime
