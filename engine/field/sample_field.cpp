// SPDX-License-Identifier: MIT
#include "engine/field/sample_field.h"

#include "engine/field/grid_depth.h"
#include "engine/lightmap/atlas.h"
#include "engine/math/lobe.h"

#include <algorithm>

#include <glm/common.hpp>

namespace limn {

namespace {

using Coefficients = std::array<glm::vec3, kMaxCoefficients>;

Coefficients sampleLightmap(const IndirectField& field, const LightmapLayout& layout, glm::vec2 uv,
                            std::size_t count) {
    const Bilinear lookup = bilinearAt(layout, uv);
    const std::size_t texels = std::size_t(field.lightmapWidth) * field.lightmapHeight;
    Coefficients c{};
    for (std::size_t i = 0; i < count; ++i)
        for (int k = 0; k < 4; ++k)
            c[i] += glm::vec3(field.lightmap[i * texels + lookup.texel[k]]) * lookup.weight[k];
    return c;
}

/// Weights of the eight cells around `p`, with sum 1: trilinear, times the visibility of `p` from
/// each.
struct GridLookup {
    std::array<std::size_t, 8> cell;
    std::array<float, 8> weight;
};

GridLookup gridLookup(const IndirectField& field, glm::vec3 p, glm::vec3 n) {
    const glm::vec3 cells(field.gridSize), cellSize = field.gridBounds.size() / cells;
    const glm::vec3 x =
        glm::clamp((p - field.gridBounds.lower) / field.gridBounds.size() * cells - 0.5f,
                   glm::vec3(0), cells - 1.f);
    const glm::uvec3 base = glm::min(glm::uvec3(x), glm::max(field.gridSize, glm::uvec3(2)) - 2U);
    const glm::vec3 f = x - glm::vec3(base);
    const glm::vec3 clear =
        p + n * (float(GRID_DEPTH_BIAS) * std::min({cellSize.x, cellSize.y, cellSize.z}));
    const float reach = gridReach(field.gridBounds, field.gridSize);
    GridLookup lookup;
    float sum = 0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const glm::uvec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::uvec3 at = glm::min(base + step, field.gridSize - 1U);
        const glm::vec3 w = glm::mix(1.f - f, f, glm::vec3(step));
        const std::size_t cell =
            (std::size_t(at.z) * field.gridSize.y + at.y) * field.gridSize.x + at.x;
        lookup.cell[corner] = cell;
        lookup.weight[corner] = w.x * w.y * w.z;
        if (field.gridDepth) {
            const glm::vec3 centre = field.gridBounds.lower + (glm::vec3(at) + 0.5f) * cellSize;
            lookup.weight[corner] *=
                float(GRID_UNSEEN) + seenFromCell(field.gridDepth->data() + cell * kGridDepthTexels,
                                                  clear - centre, reach);
        }
        sum += lookup.weight[corner];
    }
    for (float& w : lookup.weight)
        w /= sum;
    return lookup;
}

Coefficients sampleGrid(const IndirectField& field, glm::vec3 p, glm::vec3 n,
                        std::size_t coefficients) {
    const GridLookup lookup = gridLookup(field, p, n);
    const std::size_t count = std::size_t(field.gridSize.x) * field.gridSize.y * field.gridSize.z;
    Coefficients c{};
    for (std::size_t i = 0; i < coefficients; ++i)
        for (std::size_t k = 0; k < 8; ++k)
            c[i] += glm::vec3(field.grid[i * count + lookup.cell[k]]) * lookup.weight[k];
    return c;
}

/// The first bands^2 coefficients at a surface point; the others are 0.
Coefficients sampleField(const FieldPoint& at, int bands) {
    const auto count = std::size_t(bands * bands);
    const LightmapLayout& layout = at.layout;
    if (at.instance < layout.instances.size() && !layout.instances[at.instance].uv.empty())
        return sampleLightmap(at.field, layout,
                              lightmapUv(layout, at.instance, at.scene.instances[at.instance].mesh,
                                         at.triangle, at.u, at.v, at.back),
                              count);
    return at.field.grid.empty() ? Coefficients{}
                                 : sampleGrid(at.field, at.position, at.normal, count);
}

} // namespace

bool IndirectField::operator==(const IndirectField& o) const {
    const bool sameDepth =
        gridDepth && o.gridDepth ? *gridDepth == *o.gridDepth : gridDepth == o.gridDepth;
    return sameDepth && bands == o.bands && chroma() == o.chroma() &&
           lightmapWidth == o.lightmapWidth && lightmapHeight == o.lightmapHeight &&
           lightmap == o.lightmap && gridSize == o.gridSize && gridBounds == o.gridBounds &&
           grid == o.grid && version == o.version;
}

glm::vec3 sampleIrradiance(const FieldPoint& at) {
    const int bands = std::min(int(at.field.bands), kIrradianceBands);
    const Coefficients c = sampleField(at, bands);
    return glm::max(shIrradiance(bands, c.data(), at.normal), glm::vec3(0));
}

glm::vec3 sampleLobe(const FieldPoint& at, glm::vec3 direction, int bands,
                     const std::array<float, kMaxBands>& factors) {
    bands = std::min(bands, int(at.field.bands));
    const Coefficients c = sampleField(at, bands);
    return glm::max(shLobe(bands, c.data(), direction, factors), glm::vec3(0));
}

} // namespace limn
