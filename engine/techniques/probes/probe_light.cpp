// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/probe_light.h"

#include "engine/core/parallel.h"
#include "engine/field/sample_field.h"
#include "engine/math/sampling.h"
#include "engine/scene/light/unit_light.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <atomic>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kChunk = 256;           ///< texels that are summed before the others
constexpr std::uint32_t kPointsOnRectangle = 4; ///< shadow rays from a hit

/// Radiance that a hit sends towards the probe from one origin.
glm::vec3 radianceOf(const ProbeScene& in, const ProbeLight& light, std::uint32_t origin,
                     const ProbeHit& hit, const MapPoint& point, std::uint64_t& rays) {
    constexpr float kPi = std::numbers::pi_v<float>;
    if (origin < light.lights) {
        const Light unit = unitLight(in.scene.lights[origin]);
        return point.albedo / kPi *
               shadowedLight(in.trace, unit, point.lit, kPointsOnRectangle, rays);
    }
    if (origin == light.emitters())
        return point.emission;
    if (origin != light.bounced() || in.field.grid.empty())
        return glm::vec3(0);
    const LightmapLayout none; // without it, everything is lit from the grid
    return point.albedo / kPi *
           sampleIrradiance({.field = in.field,
                             .layout = none,
                             .scene = in.scene,
                             .instance = hit.instance,
                             .triangle = hit.triangle,
                             .u = hit.u,
                             .v = hit.v,
                             .position = point.lit.position,
                             .normal = point.lit.normal});
}

} // namespace

MapPoint mapPoint(const ProbeScene& in, std::uint32_t probe, std::uint32_t texel) {
    const ProbeHit& hit = in.maps.hits[std::size_t(probe) * in.maps.map.texels() + texel];
    const glm::vec3 direction = in.maps.map.direction(texel);
    const Instance& instance = in.scene.instances[hit.instance];
    const Mesh& mesh = in.scene.meshOf(instance);
    const glm::vec3 geometric =
        glm::normalize(instance.normalToWorld * triangleNormal(mesh, hit.triangle));
    const float side = hit.side == 0 ? 1.f : -1.f;
    const glm::vec3 position = in.maps.grid.position(probe) + direction * hit.distance;
    const float cosine = std::max(-side * glm::dot(geometric, direction), 0.1f);
    const float area =
        hit.distance * hit.distance * in.solidAngles[texel] / cosine; // that the texel covers
    const SurfaceMaterial material =
        surfaceMaterialOver(in.scene, instance, hit.triangle, hit.u, hit.v, area);
    const glm::vec3 normal =
        side * shadingNormal(mesh, instance, hit.triangle, {hit.u, hit.v}, geometric);
    const glm::vec2 shift(unitFloat(mixBits(texel)), unitFloat(mixBits(texel + 0x9e3779b9U)));
    return {{in.trace.clearOf(position, side * geometric), normal, shift},
            material.albedo,
            material.emission};
}

std::uint64_t lightProbe(const ProbeScene& in, std::uint32_t probe,
                         const std::vector<std::uint32_t>& origins, ProbeLight& light) {
    const std::uint32_t texels = in.maps.map.texels();
    const ProbeHit* hits = in.maps.hits.data() + std::size_t(probe) * texels;
    const std::size_t chunks = (texels + kChunk - 1) / kChunk;
    std::vector<ProbeHarmonics> sums(chunks * origins.size());
    for (const std::uint32_t o : origins)
        if (light.keepsTexels)
            light.texels[o].resize(in.maps.hits.size(), glm::vec3(0));
    const std::size_t first = std::size_t(probe) * texels;
    std::atomic<std::uint64_t> rays = 0;
    parallelRanges(chunks, 1, [&](std::size_t begin, std::size_t end) {
        std::uint64_t traced = 0;
        for (std::size_t t = begin * kChunk; t < std::min<std::size_t>(end * kChunk, texels); ++t) {
            const ProbeHit& hit = hits[t];
            if (light.keepsTexels)
                for (const std::uint32_t o : origins)
                    light.texels[o][first + t] = glm::vec3(0);
            if (hit.side == kInSolid)
                continue;
            const auto texel = std::uint32_t(t);
            const glm::vec3 direction = in.maps.map.direction(texel);
            const bool sky = hit.instance == ~0U;
            const MapPoint point = sky ? MapPoint{} : mapPoint(in, probe, texel);
            float y[kIrradianceBands * kIrradianceBands];
            shBasis(kIrradianceBands, direction, y);
            for (std::size_t o = 0; o < origins.size(); ++o) {
                glm::vec3 radiance(0);
                if (!sky)
                    radiance = radianceOf(in, light, origins[o], hit, point, traced);
                else if (origins[o] == light.sky())
                    radiance = skyRadiance(in.scene.sky, direction);
                if (light.keepsTexels)
                    light.texels[origins[o]][first + t] = radiance;
                radiance *= in.solidAngles[texel];
                ProbeHarmonics& sum = sums[t / kChunk * origins.size() + o];
                for (std::size_t i = 0; i < sum.size(); ++i)
                    sum[i] += radiance * y[i];
            }
        }
        rays += traced;
    });
    for (std::size_t o = 0; o < origins.size(); ++o) {
        ProbeHarmonics total{};
        for (std::size_t c = 0; c < chunks; ++c)
            for (std::size_t i = 0; i < total.size(); ++i)
                total[i] += sums[c * origins.size() + o][i];
        light.part(probe, origins[o]) = total;
    }
    return rays;
}

} // namespace limn
