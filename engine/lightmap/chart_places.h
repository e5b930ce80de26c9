// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// Properties of a mesh's charts that do not depend on the texel density.
struct MeshChartShapes {
    std::vector<std::uint32_t> begin, triangles; ///< chart c has triangles[begin[c] … begin[c+1])
    std::vector<std::uint8_t> side; ///< direction most of its area faces: +x, -x, +y, -y, +z, -z
    std::vector<double> area;       ///< area of one side in object space [m^2]
    std::vector<glm::vec3> lower, upper; ///< bounds in object space

    std::span<const std::uint32_t> trianglesOf(std::uint32_t chart) const {
        return {triangles.data() + begin[chart], begin[chart + 1] - begin[chart]};
    }
};
MeshChartShapes shapesOf(const Mesh& mesh, const MeshCharts& charts);

/// Input of placeCharts(). Texels per object unit are the texels per metre in the world times
/// `scale`.
struct AtlasInput {
    const Scene& scene;
    const std::vector<MeshCharts>& charts; ///< per mesh
    std::vector<MeshChartShapes> shapes;   ///< per mesh
    std::vector<float> scale;              ///< per instance: its atlasScale
    /// Multiplies the density [texels per metre], per instance and chart. Empty, as a whole or for
    /// an instance, means 1.
    std::vector<std::vector<float>> factor;

    float factorOf(std::uint32_t instance, std::uint32_t chart) const {
        return factor.empty() || factor[instance].empty() ? 1 : factor[instance][chart];
    }
};

/// Input with every factor 1.
AtlasInput atlasInput(const Scene& scene, const std::vector<MeshCharts>& charts);

bool hasLightmap(const AtlasInput& in, const Instance& instance);

/// Number of lit sides: 2 if the instance's material is two-sided, else 1.
std::uint32_t sidesOf(const AtlasInput& in, const Instance& instance);

/// A rectangle of texels onto which one or several charts of an instance are drawn. Its borders lie
/// on texel centres.
struct ChartPlace {
    std::uint32_t instance;
    std::uint32_t sides; ///< number of sides, each of which needs such a rectangle
    float factor = 1;    ///< AtlasInput::factor of its charts
    std::vector<std::uint32_t> charts;
    /// Plane of the charts. -1: the plane of its only chart (MeshCharts::chartUv); otherwise the
    /// plane of the object's axes (axis + 1) mod 3 and (axis + 2) mod 3.
    int axis = -1;
    glm::uvec2 size{1};   ///< texels
    glm::vec2 lower{0};   ///< lower corner in the plane
    glm::vec2 scale{0};   ///< texels per object unit; 0 along a side of one texel
    glm::ivec2 offset{0}; ///< position in the atlas, set by packing

    glm::vec2 toTexels(glm::vec2 plane) const { return (plane - lower) * scale + 0.5f; }
};

/// Corner k of a triangle in texels of the place, relative to its offset.
glm::vec2 cornerInPlace(const AtlasInput& in, const ChartPlace& place, std::uint32_t triangle,
                        std::uint32_t k);

/// Places for all charts of all static instances at `density` texels per metre.
///
/// A separate place costs half a texel on every side beyond the chart's own area, so a mesh of
/// tiny pieces would use up the texels of the large ones. Where the place is more than nine times
/// the chart's area, as that of a strip narrower than an eighth of a texel or of a square of less
/// than half a texel, charts of an instance share a place: charts that face the same side, lie in
/// the same slab about one texel thick and have touching texels are drawn over each other along the
/// object's axis. A texel then represents everything inside it, whichever piece it belongs to.
/// Strips wider than that keep their own light, because the parts of mouldings and window frames,
/// centimetres apart, differ in light by factors.
std::vector<ChartPlace> placeCharts(const AtlasInput& in, float density);

} // namespace limn
