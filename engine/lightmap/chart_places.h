// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/lightmap_layout.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// What does not depend on the density of texels, of one mesh, chart by chart.
struct MeshChartShapes {
    std::vector<std::uint32_t> begin, triangles; ///< of chart c: triangles[begin[c] … begin[c+1])
    std::vector<std::uint8_t> side;      ///< that most of its area faces: +x, -x, +y, -y, +z, -z
    std::vector<double> area;            ///< of one side in object space [m^2]
    std::vector<glm::vec3> lower, upper; ///< bounds in object space

    std::span<const std::uint32_t> trianglesOf(std::uint32_t chart) const {
        return {triangles.data() + begin[chart], begin[chart + 1] - begin[chart]};
    }
};
MeshChartShapes shapesOf(const Mesh& mesh, const MeshCharts& charts);

/// Texels per world metre make so many texels per object unit: the instance's atlasScale.
struct AtlasInput {
    const Scene& scene;
    const std::vector<MeshCharts>& charts; ///< per mesh
    std::vector<MeshChartShapes> shapes;   ///< per mesh
    std::vector<float> scale;              ///< per instance
    /// Per instance and chart, times the density [texels per metre]; empty, also per instance: 1.
    std::vector<std::vector<float>> factor;

    float factorOf(std::uint32_t instance, std::uint32_t chart) const {
        return factor.empty() || factor[instance].empty() ? 1 : factor[instance][chart];
    }
};

/// With every factor 1.
AtlasInput atlasInput(const Scene& scene, const std::vector<MeshCharts>& charts);

bool hasLightmap(const AtlasInput& in, const Instance& instance);

/// That are lit: 2 where the instance's material shows both.
std::uint32_t sidesOf(const AtlasInput& in, const Instance& instance);

/// A rectangle of texels onto which one or several charts of an instance are drawn. Its borders lie
/// on texel centres.
struct ChartPlace {
    std::uint32_t instance;
    std::uint32_t sides; ///< that need such a rectangle each
    float factor = 1;    ///< AtlasInput::factor of its charts
    std::vector<std::uint32_t> charts;
    /// The charts' plane: -1, that of its only chart (MeshCharts::chartUv); else the plane of the
    /// object's axes (axis + 1) mod 3 and (axis + 2) mod 3.
    int axis = -1;
    glm::uvec2 size{1};   ///< texels
    glm::vec2 lower{0};   ///< in the plane
    glm::vec2 scale{0};   ///< texels per object unit; 0 along a side of one texel
    glm::ivec2 offset{0}; ///< in the atlas, once packed

    glm::vec2 toTexels(glm::vec2 plane) const { return (plane - lower) * scale + 0.5f; }
};

/// Corner k of a triangle in the place's texels, relative to its offset.
glm::vec2 cornerInPlace(const AtlasInput& in, const ChartPlace& place, std::uint32_t triangle,
                        std::uint32_t k);

/// Places for all charts of all static instances at `density` texels per metre.
///
/// A chart of its own costs half a texel more all round than its area is worth, so a mesh of small
/// or narrow pieces would eat up the texels of the large ones. Where the border outweighs the area
/// by more than half, charts of an instance share a place: those that face the same side, lie in
/// the same slab of about a texel's thickness, and whose texels touch, are drawn over each other
/// along the object's axis. So a texel serves what lies within it, whichever piece it belongs to.
std::vector<ChartPlace> placeCharts(const AtlasInput& in, float density);

} // namespace limn
