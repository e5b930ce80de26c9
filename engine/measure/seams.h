// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/scene.h"

namespace limn {

/// Visibility of the borders between charts: the difference of irradiance [W m^-2] between lookups
/// from either side, at the same normal, along edges where two triangles of a mesh meet within 30
/// degrees of a plane but lie in different charts. Means are weighted by length.
struct SeamError {
    double jump = 0;       ///< mean |E_a - E_b| over the edges, mean of the channels
    double irradiance = 0; ///< mean E over the edges, both sides, mean of the channels
    double length = 0;     ///< total length of those edges in the world [m]

    /// The jump relative to the irradiance: the figure to quote.
    double relative() const { return irradiance > 0 ? jump / irradiance : 0; }
};

SeamError measureSeams(const Scene& scene, const LightmapLayout& layout,
                       const IndirectField& field);

} // namespace limn
