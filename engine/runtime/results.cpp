// SPDX-License-Identifier: MIT
#include "engine/runtime/grid.h"
#include "engine/runtime/scene.h"

#include <algorithm>
#include <cstring>

using namespace limn::runtime;

namespace {

constexpr float kUnorm = 1.f / 65535;

/// IEEE 754 binary16, rounded to nearest even, cut off at the largest half.
std::uint16_t halfOf(float value) {
    constexpr float kLargest = 65504;
    value = std::clamp(value, -kLargest, kLargest);
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    const auto sign = std::uint16_t(bits >> 16 & 0x8000U);
    const float magnitude = std::fabs(value);
    if (magnitude < 0x1p-14f)
        return std::uint16_t(sign | std::uint16_t(std::nearbyint(magnitude * 0x1p24f)));
    const std::uint32_t m = bits & 0x7fffffffU;
    return std::uint16_t(sign |
                         std::uint16_t(((m + 0xfffU + (m >> 13 & 1U)) >> 13) - (112U << 10)));
}

/// Calls write(texel, coefficients, coverage) for each texel, its coefficients and 1, or 0 where no
/// chart lies.
template <class Write>
void forTexels(const limnrt_scene& s, const Write& write) {
    const TransportView& v = s.view;
    const std::size_t count = s.coefficients();
    F4 sum[kMaxBands * kMaxBands];
    for (std::size_t t = 0; t < v.dims.texels(); ++t) {
        const std::uint32_t begin = v.partBegin[t], end = v.partBegin[t + 1];
        std::fill(sum, sum + count, F4{});
        for (std::uint32_t k = begin; k < end; ++k) {
            const F4* sh = s.sh + v.partCache[k] * count;
            const F4 weight = splat(float(v.partWeight[k]) * kUnorm);
            for (std::size_t i = 0; i < count; ++i)
                sum[i] += sh[i] * weight;
        }
        write(t, sum, begin < end ? 1.f : 0.f);
    }
}

/// Calls write(texel, irradiance) for each texel, with its coverage in the fourth place.
template <class Write>
void forIrradiance(limnrt_scene& s, const float* normals, const Write& write) {
    lightResults(s, false);
    const TransportView& v = s.view;
    if (normals) {
        forTexels(s, [&](std::size_t t, const F4* sh, float coverage) {
            F4 irradiance = irradianceOf(s, sh, normals + 3 * t);
            irradiance[3] = coverage;
            write(t, irradiance);
        });
        return;
    }
    for (std::size_t c = 0; c < v.dims.lightmapCaches; ++c)
        s.cacheIrradiance[c] = irradianceOf(s, s.sh + c * s.coefficients(), v.cacheNormal + 3 * c);
    for (std::size_t t = 0; t < v.dims.texels(); ++t) {
        F4 sum{};
        for (std::uint32_t k = v.partBegin[t]; k < v.partBegin[t + 1]; ++k)
            sum += s.cacheIrradiance[v.partCache[k]] * splat(float(v.partWeight[k]) * kUnorm);
        sum[3] = v.partBegin[t] < v.partBegin[t + 1] ? 1.f : 0.f;
        write(t, sum);
    }
}

bool canSample(const limnrt_scene& s, const float* position, const float* normal) {
    bool fine = s.view.dims.cells() > 0;
    for (int k = 0; k < 3; ++k)
        fine = fine && std::fabs(position[k]) <= 1e12f && std::fabs(normal[k]) <= 1.01f;
    return fine;
}

F4 sampleCoefficient(const limnrt_scene& s, const GridLookup& lookup, std::size_t i) {
    F4 sum{};
    for (int k = 0; k < 8; ++k)
        sum += s.sh[(s.view.dims.lightmapCaches + lookup.cell[k]) * s.coefficients() + i] *
               splat(lookup.weight[k]);
    return sum;
}

} // namespace

void limnrt_get_counts(const limnrt_scene* s, limnrt_counts* counts) {
    const Dims& d = s->view.dims;
    *counts = {};
    counts->surfels = d.surfels;
    counts->sky_cells = d.skyCells;
    counts->nodes = std::uint32_t(d.nodes());
    counts->caches = d.caches;
    counts->lightmap_caches = d.lightmapCaches;
    counts->materials = d.materials;
    counts->lights = d.lights;
    counts->max_lights = s->options.max_lights;
    counts->triangles = d.triangles;
    counts->bands = s->results.luma;
    counts->chroma_bands = s->results.chroma;
    counts->lightmap_width = d.lightmapWidth;
    counts->lightmap_height = d.lightmapHeight;
    std::copy_n(d.grid, 3, counts->grid);
    std::copy_n(s->view.space->gridLower, 3, counts->grid_lower);
    std::copy_n(s->view.space->gridUpper, 3, counts->grid_upper);
    counts->links = d.links;
    counts->memory = s->memory;
}

const char* limnrt_meta(const limnrt_scene* s, size_t* size) {
    *size = s->view.metaBytes;
    return s->view.meta;
}
const char* limnrt_material_name(const limnrt_scene* s, uint32_t index) {
    if (index >= s->view.dims.materials)
        return nullptr;
    const char* name = s->view.names;
    for (; index > 0; --index)
        name += std::strlen(name) + 1;
    return name;
}
const float* limnrt_surfel_positions(const limnrt_scene* s) {
    return s->view.surfelPosition;
}
const float* limnrt_surfel_normals(const limnrt_scene* s) {
    return s->view.surfelNormal;
}
const float* limnrt_light_points(const limnrt_scene* s, uint32_t* each) {
    *each = s->view.lightPointsEach;
    return s->view.lightPoint;
}
const float* limnrt_light_normals(const limnrt_scene* s) {
    return s->view.lightNormal;
}
const float* limnrt_surfel_areas(const limnrt_scene* s) {
    return s->view.surfelArea;
}
const uint32_t* limnrt_surfel_materials(const limnrt_scene* s) {
    return s->view.surfelMaterial;
}
const uint32_t* limnrt_surfel_instances(const limnrt_scene* s) {
    return s->view.surfelInstance;
}
const float* limnrt_cache_positions(const limnrt_scene* s) {
    return s->view.cachePosition;
}
const float* limnrt_cache_normals(const limnrt_scene* s) {
    return s->view.cacheNormal;
}
const float* limnrt_sky_directions(const limnrt_scene* s) {
    return s->view.skyDirection;
}
const float* limnrt_file_sky(const limnrt_scene* s) {
    return s->view.skyRadiance;
}
const limnrt_light* limnrt_file_lights(const limnrt_scene* s) {
    return s->view.lights;
}
const float* limnrt_direct(const limnrt_scene* s) {
    return reinterpret_cast<const float*>(s->direct);
}
const float* limnrt_radiosity(const limnrt_scene* s) {
    return reinterpret_cast<const float*>(s->radiosity);
}

const float* limnrt_cache_sh(limnrt_scene* s) {
    lightResults(*s, false);
    lightResults(*s, true);
    return reinterpret_cast<const float*>(s->sh);
}

void limnrt_lightmap_sh(limnrt_scene* s, float* rgba) {
    lightResults(*s, false);
    const std::size_t count = s->coefficients(), layer = 4 * s->view.dims.texels();
    forTexels(*s, [&](std::size_t t, F4* sh, float coverage) {
        for (std::size_t i = 0; i < count; ++i) {
            sh[i][3] = coverage;
            std::memcpy(rgba + i * layer + 4 * t, &sh[i], sizeof sh[i]);
        }
    });
}

void limnrt_lightmap_sh_half(limnrt_scene* s, float scale, uint16_t* rgba) {
    lightResults(*s, false);
    const std::size_t count = s->coefficients(), layer = 4 * s->view.dims.texels();
    forTexels(*s, [&](std::size_t t, const F4* sh, float coverage) {
        for (std::size_t i = 0; i < count; ++i) {
            std::uint16_t* out = rgba + i * layer + 4 * t;
            for (int k = 0; k < 3; ++k)
                out[k] = halfOf(sh[i][k] * scale);
            out[3] = halfOf(coverage);
        }
    });
}

void limnrt_lightmap_irradiance(limnrt_scene* s, const float* normals, float* rgba) {
    forIrradiance(*s, normals,
                  [&](std::size_t t, F4 e) { std::memcpy(rgba + 4 * t, &e, sizeof e); });
}

void limnrt_lightmap_irradiance_half(limnrt_scene* s, const float* normals, float scale,
                                     uint16_t* rgba) {
    forIrradiance(*s, normals, [&](std::size_t t, F4 e) {
        std::uint16_t* out = rgba + 4 * t;
        for (int k = 0; k < 3; ++k)
            out[k] = halfOf(e[k] * scale);
        out[3] = halfOf(e[3]);
    });
}

void limnrt_grid_sh(limnrt_scene* s, float* rgba) {
    lightResults(*s, true);
    const std::size_t cells = s->view.dims.cells(), count = s->coefficients();
    const F4* sh = s->sh + s->view.dims.lightmapCaches * count;
    for (std::size_t c = 0; c < cells; ++c)
        for (std::size_t i = 0; i < count; ++i)
            std::memcpy(rgba + 4 * (i * cells + c), &sh[c * count + i], sizeof *sh);
}

int limnrt_sample_grid(limnrt_scene* s, const float position[3], const float normal[3],
                       float rgb[3]) {
    if (!canSample(*s, position, normal))
        return 0;
    lightResults(*s, true);
    const GridLookup lookup = gridLookup(s->view, position, normal);
    F4 sh[9];
    for (std::size_t i = 0; i < std::size_t(s->inner.luma) * s->inner.luma; ++i)
        sh[i] = sampleCoefficient(*s, lookup, i);
    const F4 irradiance = irradianceOf(*s, sh, normal);
    std::memcpy(rgb, &irradiance, 3 * sizeof(float));
    return 1;
}

int limnrt_sample_grid_sh(limnrt_scene* s, const float position[3], const float normal[3],
                          float* rgba) {
    if (!canSample(*s, position, normal))
        return 0;
    lightResults(*s, true);
    const GridLookup lookup = gridLookup(s->view, position, normal);
    for (std::size_t i = 0; i < s->coefficients(); ++i) {
        const F4 value = sampleCoefficient(*s, lookup, i);
        std::memcpy(rgba + 4 * i, &value, sizeof value);
    }
    return 1;
}
