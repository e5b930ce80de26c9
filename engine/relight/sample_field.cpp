// SPDX-License-Identifier: MIT
#include "engine/bake/atlas.h"
#include "engine/math/lobe.h"
#include "engine/relight/relight.h"

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

Coefficients sampleGrid(const IndirectField& field, glm::vec3 p, std::size_t coefficients) {
    const glm::vec3 cells(field.gridSize);
    const glm::vec3 x =
        glm::clamp((p - field.gridBounds.lower) / field.gridBounds.size() * cells - 0.5f,
                   glm::vec3(0), cells - 1.f);
    const glm::uvec3 base = glm::min(glm::uvec3(x), glm::max(field.gridSize, glm::uvec3(2)) - 2U);
    const glm::vec3 f = x - glm::vec3(base);
    const std::size_t count = std::size_t(field.gridSize.x) * field.gridSize.y * field.gridSize.z;
    Coefficients c{};
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::uvec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::uvec3 at = glm::min(base + step, field.gridSize - 1U);
        const glm::vec3 w = glm::mix(1.f - f, f, glm::vec3(step));
        const std::size_t cell =
            (std::size_t(at.z) * field.gridSize.y + at.y) * field.gridSize.x + at.x;
        for (std::size_t i = 0; i < coefficients; ++i)
            c[i] += glm::vec3(field.grid[i * count + cell]) * (w.x * w.y * w.z);
    }
    return c;
}

/// The first bands^2 coefficients at a surface point, the others 0.
Coefficients sampleField(const FieldPoint& at, int bands) {
    const auto count = std::size_t(bands * bands);
    const LightmapLayout& layout = at.layout;
    if (at.instance < layout.instances.size() && !layout.instances[at.instance].uv.empty())
        return sampleLightmap(at.field, layout,
                              lightmapUv(layout, at.instance, at.scene.instances[at.instance].mesh,
                                         at.triangle, at.u, at.v),
                              count);
    return at.field.grid.empty() ? Coefficients{} : sampleGrid(at.field, at.position, count);
}

} // namespace

glm::vec3 sampleIrradiance(const IndirectField& field, const LightmapLayout& layout,
                           const Scene& scene, std::uint32_t instance, std::uint32_t triangle,
                           float u, float v, glm::vec3 position, glm::vec3 n) {
    const int bands = std::min(int(field.bands), kIrradianceBands);
    const Coefficients c =
        sampleField({field, layout, scene, instance, triangle, u, v, position}, bands);
    return glm::max(shIrradiance(bands, c.data(), n), glm::vec3(0));
}

glm::vec3 sampleLobe(const FieldPoint& at, glm::vec3 direction, int bands,
                     const std::array<float, kMaxBands>& factors) {
    bands = std::min(bands, int(at.field.bands));
    const Coefficients c = sampleField(at, bands);
    return glm::max(shLobe(bands, c.data(), direction, factors), glm::vec3(0));
}

} // namespace limn
