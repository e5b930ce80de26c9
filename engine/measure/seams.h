// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <functional>

#include <glm/vec3.hpp>

namespace limn {

/// Visibility of the borders between charts: the difference of what lookups from either side find,
/// at the same normal, along edges where two triangles of a mesh lie in different charts. Means are
/// weighted by length.
struct SeamError {
    double jump = 0;       ///< mean |E_a - E_b| over the edges, mean of the channels [W m^-2]
    double irradiance = 0; ///< mean E over the edges, both sides, mean of the channels [W m^-2]
    double length = 0;     ///< total length of those edges in the world [m]

    /// The jump relative to the irradiance: the figure to quote.
    double relative() const { return irradiance > 0 ? jump / irradiance : 0; }
};

/// Which edges between charts are seams, and how they are measured.
struct SeamEdges {
    /// false: those of triangles within 30 degrees of a plane. true: those where the shading
    /// normals of both sides differ by less than 2 degrees, so that no light may jump.
    bool smooth = false;
    std::uint32_t samples = 4; ///< points of each edge
};

/// What a lookup shows at a point on the front of an instance, for the unit normal `n`.
using SeamLight =
    std::function<glm::vec3(std::uint32_t instance, const MeshPoint& point, glm::vec3 n)>;

/// Measures the edges of all instances with a lightmap; of `layout`, their charts are read.
SeamError measureSeams(const Scene& scene, const LightmapLayout& layout, const SeamLight& light,
                       const SeamEdges& edges = {});

/// The same for the irradiance of a field.
SeamError measureSeams(const Scene& scene, const LightmapLayout& layout,
                       const IndirectField& field);

} // namespace limn
