// SPDX-License-Identifier: MIT
#pragma once

#include "engine/runtime/transport_view.h"

namespace limn::runtime {

/// The eight cells around a point, with weights that sum to 1.
struct GridLookup {
    std::uint32_t cell[8];
    float weight[8];
};

/// Trilinear weights times the visibility of `position` from each cell, by the cells' depth maps.
/// Precondition: there is a grid.
GridLookup gridLookup(const TransportView& view, const float* position, const float* normal);

} // namespace limn::runtime
