// SPDX-License-Identifier: MIT
#include "engine/field/sample_field.h"

#include "engine/field/grid_cells.h"
#include "engine/field/grid_depth.h"
#include "engine/lightmap/atlas.h"
#include "engine/math/hemisphere_radiance.h"
#include "engine/math/horizon.h"
#include "engine/math/lobe.h"

#include <algorithm>

#include <glm/common.hpp>

namespace limn {

namespace {

/// Those of irradiance.
using IrradianceCoefficients = std::array<glm::vec3, kIrradianceBands * kIrradianceBands>;

/// A surface point at which the grid is read.
struct GridPoint {
    glm::vec3 position, normal;
    glm::vec3 clear; ///< the position, slightly off the surface
    float reach;     ///< of the grid [m]
};

/// Weight of a cell besides the trilinear one.
float cellWeight(const IndirectField& field, std::uint32_t cell, glm::vec3 centre,
                 const GridPoint& point) {
    if (field.gridMoments) {
        const glm::vec3 p = field.gridMoments->smooth ? point.clear : point.position;
        return momentsWeight(*field.gridMoments, cell, p - centre, point.normal);
    }
    if (!field.gridDepth)
        return 1;
    return float(GRID_UNSEEN) +
           seenFromCell(field.gridDepth->data() + std::size_t(cell) * kGridDepthTexels,
                        point.clear - centre, point.reach);
}

} // namespace

FieldLookup gridLookup(const IndirectField& field, glm::vec3 position, glm::vec3 normal) {
    const glm::vec3 cellSize = field.gridBounds.size() / glm::vec3(field.gridSize);
    const CellsAbout about = cellsAbout(field.gridBounds, field.gridSize, position);
    const float bias = float(GRID_DEPTH_BIAS) * std::min({cellSize.x, cellSize.y, cellSize.z});
    const GridPoint point{position, normal, position + normal * bias,
                          gridReach(field.gridBounds, field.gridSize)};
    FieldLookup lookup{.grid = true, .count = 8};
    float sum = 0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const glm::uvec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::vec3 w = glm::mix(1.f - about.f, about.f, glm::vec3(step));
        const std::uint32_t cell = about.index[corner];
        lookup.index[corner] = cell;
        const glm::vec3 centre =
            field.gridBounds.lower + (glm::vec3(about.cell[corner]) + 0.5f) * cellSize;
        lookup.weight[corner] = w.x * w.y * w.z * cellWeight(field, cell, centre, point);
        sum += lookup.weight[corner];
    }
    if (!(sum > 0))
        return {.grid = true};
    for (float& w : lookup.weight)
        w /= sum;
    return lookup;
}

namespace {

/// Adds the first bands^2 coefficients of the light above a surface point to `c`, which are 0. At
/// least 2 bands.
void sampleField(const FieldPoint& point, int bands, glm::vec3* c) {
    const FieldLookup lookup = lookUp(point);
    const IndirectField& field = point.field;
    const std::vector<glm::vec4>& values = lookup.grid ? field.grid : field.lightmap;
    const std::size_t stride = values.size() / field.coefficients();
    for (std::size_t i = 0; i < std::size_t(bands * bands); ++i)
        for (std::size_t k = 0; k < lookup.count; ++k)
            c[i] += glm::vec3(values[i * stride + lookup.index[k]]) * lookup.weight[k];
    if (field.continues && !lookup.grid && lookup.count > 0)
        cutBelow(point.surfaceNormal(), c);
}

/// Adds what the field's other parts contribute.
template <class AddTaps>
void addParts(const FieldPoint& point, glm::vec3& value, const AddTaps& addTaps) {
    if (point.field.parts.empty())
        return;
    FieldTaps taps;
    for (const auto& part : point.field.parts) {
        taps.clear();
        addTaps(*part, taps);
        value += part->sum(taps);
    }
}

} // namespace

bool IndirectField::operator==(const IndirectField& o) const {
    const bool sameDepth =
        gridDepth && o.gridDepth ? *gridDepth == *o.gridDepth : gridDepth == o.gridDepth;
    const bool sameParts = std::ranges::equal(
        parts, o.parts, [](const auto& a, const auto& b) { return a->equals(*b); });
    return sameDepth && sameParts && continues == o.continues && gridMoments == o.gridMoments &&
           bands == o.bands && chroma() == o.chroma() && lightmapWidth == o.lightmapWidth &&
           lightmapHeight == o.lightmapHeight && lightmap == o.lightmap && gridSize == o.gridSize &&
           gridBounds == o.gridBounds && grid == o.grid && version == o.version;
}

FieldLookup lookUp(const FieldPoint& point) {
    const LightmapLayout& layout = point.layout;
    if (point.instance >= layout.instances.size() || layout.instances[point.instance].uv.empty())
        return point.field.grid.empty() ? FieldLookup{}
                                        : gridLookup(point.field, point.position, point.normal);
    const bool leftOut = point.back && layout.instances[point.instance].backRows == 0;
    if (point.field.lightmap.empty() || leftOut)
        return {};
    const Bilinear b = bilinearAt(layout, lightmapUv(layout, point.instance,
                                                     point.scene.instances[point.instance].mesh,
                                                     point.triangle, point.u, point.v, point.back));
    FieldLookup lookup{.count = 4};
    std::copy_n(b.texel, 4, lookup.index.begin());
    std::copy_n(b.weight, 4, lookup.weight.begin());
    return lookup;
}

glm::vec3 sampleIrradiance(const FieldPoint& point) {
    const int bands = std::min(int(point.field.bands), kIrradianceBands);
    IrradianceCoefficients c{};
    sampleField(point, bands, c.data());
    glm::vec3 irradiance = shIrradiance(bands, c.data(), point.normal);
    addParts(point, irradiance,
             [&](const FieldPart& part, FieldTaps& taps) { part.irradianceTaps(point, taps); });
    return glm::max(irradiance, glm::vec3(0));
}

glm::vec3 sampleRadiance(const FieldPoint& point, glm::vec3 direction) {
    const int bands = std::min(int(point.field.bands), kIrradianceBands);
    IrradianceCoefficients c{};
    sampleField(point, bands, c.data());
    float w[kIrradianceBands * kIrradianceBands];
    hemisphereRadianceWeights(bands, point.normal, direction, w);
    glm::vec3 radiance(0);
    for (int i = 0; i < bands * bands; ++i)
        radiance += w[i] * c[std::size_t(i)];
    addParts(point, radiance, [&](const FieldPart& part, FieldTaps& taps) {
        part.radianceTaps(point, direction, taps);
    });
    return glm::max(radiance, glm::vec3(0));
}

glm::vec3 sampleLobe(const FieldPoint& point, glm::vec3 direction, int bands,
                     const std::array<float, kMaxBands>& factors) {
    const int stored = std::min(bands, int(point.field.bands));
    std::array<glm::vec3, kMaxCoefficients> c{};
    sampleField(point, stored, c.data());
    glm::vec3 radiance = shLobe(stored, c.data(), direction, factors);
    addParts(point, radiance, [&](const FieldPart& part, FieldTaps& taps) {
        part.lobeTaps(point, direction, bands, factors, taps);
    });
    return glm::max(radiance, glm::vec3(0));
}

const FieldPart* reflectingPart(const IndirectField& field) {
    for (const auto& part : field.parts)
        if (part->reflects())
            return part.get();
    return nullptr;
}

SampledReflection sampleReflection(const FieldPart& part, const ReflectedLobe& lobe) {
    FieldTaps taps;
    const bool known = part.reflectionTaps(lobe, taps);
    return {part.sum(taps), known};
}

} // namespace limn
