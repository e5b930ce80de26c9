// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/layout/lightmap_layout.h"

namespace limn {

/// Turns each chart in its plane so that the rectangle around it, which an atlas keeps for it, is
/// small: along one of its longest edges, as a smallest rectangle has a side along an edge of the
/// convex hull (Freeman, Shapira. Determining the Minimum-Area Encasing Rectangle for an Arbitrary
/// Closed Curve. 1975). Charts that gain next to nothing stay as they are.
void straightenCharts(MeshCharts& charts);

} // namespace limn
