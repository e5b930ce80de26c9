// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/cache_light.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::size_t kLanes = 8; // caches that are lit together
constexpr float kInvPi = std::numbers::inv_pi_v<float>;

/// The sine of half the angle of the widest cone. Wider ones meet the walls beside the way of the
/// light.
constexpr float kWidestSine = 0.25f;
/// Voxels by which both ends of a cone are raised above their surfaces, whose own voxels would
/// otherwise dim light that runs along them.
constexpr float kRaised = 2;

using Lanes = float[kLanes];

/// Factor of the polynomial y, z, x, xy, yz, 3z^2-1, xz or x^2-y^2 in harmonic `i` (sh.h); that of
/// harmonic 0 is 1.
float harmonicFactor(int i) {
    constexpr float kQuarter = kInvPi / 4;
    switch (i) {
    case 0:
        return std::sqrt(kQuarter);
    case 1:
    case 2:
    case 3:
        return std::sqrt(3 * kQuarter);
    case 6:
        return std::sqrt(5 * kQuarter / 4);
    case 8:
        return std::sqrt(15 * kQuarter / 4);
    default:
        return std::sqrt(15 * kQuarter);
    }
}

/// What arrives at some caches from one area light.
struct ArrivalLanes {
    Lanes dx, dy, dz; ///< unit directions towards it
    Lanes factor;     ///< of its flux
};

/// Caches that are lit together; the last ones may be repeated.
struct CacheLanes {
    Lanes x, y, z;
    explicit CacheLanes(std::span<const CachePlace> caches) {
        for (std::size_t k = 0; k < kLanes; ++k) {
            const glm::vec3 p = caches[std::min(k, caches.size() - 1)].position;
            x[k] = p.x, y[k] = p.y, z[k] = p.z;
        }
    }
};

/// From area light `j`, without its flux. `visible`: the share of its block that reaches each
/// cache.
inline void arrive(const CacheLanes& caches, const AreaLights& lights, std::size_t j,
                   const Lanes& visible, ArrivalLanes& a) {
    const float px = lights.x[j], py = lights.y[j], pz = lights.z[j];
    const float nx = lights.nx[j], ny = lights.ny[j], nz = lights.nz[j], disc = lights.disc[j];
    Lanes squared, length;
    for (std::size_t k = 0; k < kLanes; ++k) {
        a.dx[k] = px - caches.x[k];
        a.dy[k] = py - caches.y[k];
        a.dz[k] = pz - caches.z[k];
        squared[k] = a.dx[k] * a.dx[k] + a.dy[k] * a.dy[k] + a.dz[k] * a.dz[k];
    }
    for (std::size_t k = 0; k < kLanes; ++k)
        length[k] = std::sqrt(squared[k]);
    for (std::size_t k = 0; k < kLanes; ++k) {
        const float inverse = length[k] > 0 ? 1 / length[k] : 0.f;
        a.dx[k] *= inverse;
        a.dy[k] *= inverse;
        a.dz[k] *= inverse;
        const float cosine = std::max(-(a.dx[k] * nx + a.dy[k] * ny + a.dz[k] * nz), 0.f);
        a.factor[k] = kInvPi * cosine * visible[k] /
                      std::max(squared[k] + disc, std::numeric_limits<float>::min());
    }
}

/// Sums of the polynomials of the harmonics over arrivals, for each colour.
template <int Count>
struct Sums {
    float value[3][Count][kLanes] = {};

    void add(const ArrivalLanes& a, glm::vec3 flux) {
        float p[Count][kLanes];
        for (std::size_t k = 0; k < kLanes; ++k) {
            const float x = a.dx[k], y = a.dy[k], z = a.dz[k], e = a.factor[k];
            p[0][k] = e;
            p[1][k] = e * y;
            p[2][k] = e * z;
            p[3][k] = e * x;
            if constexpr (Count > 4) {
                p[4][k] = e * x * y;
                p[5][k] = e * y * z;
                p[6][k] = e * (3 * z * z - 1);
                p[7][k] = e * x * z;
                p[8][k] = e * (x * x - y * y);
            }
        }
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < Count; ++i)
                for (std::size_t k = 0; k < kLanes; ++k)
                    value[c][i][k] += p[i][k] * flux[c];
    }
};

/// Whether any area light of the block faces the cache.
bool faces(const AreaLights& lights, const AreaLightBlock& block, glm::vec3 cache) {
    for (std::uint32_t j = block.begin; j < block.end; ++j)
        if ((cache.x - lights.x[j]) * lights.nx[j] + (cache.y - lights.y[j]) * lights.ny[j] +
                (cache.z - lights.z[j]) * lights.nz[j] >
            0)
            return true;
    return false;
}

/// Visibility of a block from each cache; returns how many it faces.
std::size_t visibleLanes(const CacheLightInput& input, const AreaLights& lights,
                         const AreaLightBlock& block, std::span<const CachePlace> places,
                         Lanes& visible) {
    std::size_t faced = 0;
    for (std::size_t k = 0; k < kLanes; ++k) {
        const bool facing = k < places.size() && faces(lights, block, places[k].position);
        faced += facing ? 1 : 0;
        visible[k] = facing ? blockVisibility(input, block, places[k]) : 0.f;
    }
    return faced;
}

void addGlossy(const GlossyMapShape& shape, std::span<const glm::mat3> frames,
               const ArrivalLanes& a, glm::vec3 flux, std::span<glm::vec3> maps) {
    for (std::size_t k = 0; k < frames.size(); ++k) {
        if (!(a.factor[k] > 0))
            continue;
        const GlossySplat splat = glossySplat(shape, frames[k], {a.dx[k], a.dy[k], a.dz[k]});
        maps[k * shape.texels() + splat.texel] += flux * (a.factor[k] * splat.factor);
    }
}

/// Lights up to kLanes caches. `harmonics` and `maps` are theirs.
template <int Count>
void lightLanes(std::span<const CachePlace> places, const CacheLightInput& input,
                std::span<glm::vec3> harmonics, std::span<glm::vec3> maps, std::uint64_t& cones) {
    const CacheLanes caches(places);
    std::vector<glm::mat3> frames;
    if (input.glossy)
        for (const CachePlace& place : places)
            frames.push_back(glossyFrame(input.eye - place.position));
    Sums<Count> sums;
    Lanes visible;
    ArrivalLanes arrival;
    for (const LitAreaLights& lit : input.lights)
        for (const AreaLightBlock& block : lit.lights->blocks) {
            const std::size_t faced = visibleLanes(input, *lit.lights, block, places, visible);
            if (faced == 0)
                continue;
            cones += faced;
            for (std::uint32_t j = block.begin; j < block.end; ++j) {
                const glm::vec3 flux = lit.lights->flux[j] * lit.colour;
                arrive(caches, *lit.lights, j, visible, arrival);
                sums.add(arrival, flux);
                if (input.glossy)
                    addGlossy(*input.glossy, frames, arrival, flux, maps);
            }
        }
    for (std::size_t k = 0; k < places.size(); ++k)
        for (int i = 0; i < Count; ++i)
            for (int c = 0; c < 3; ++c)
                harmonics[k * Count + std::size_t(i)][c] = harmonicFactor(i) * sums.value[c][i][k];
    if (input.glossy)
        for (std::size_t k = 0; k < places.size(); ++k)
            completeGlossyMap(*input.glossy,
                              maps.subspan(k * input.glossy->texels(), input.glossy->texels()));
}

} // namespace

float coneRaise(ConeShadows shadows, float voxel) {
    return shadows == ConeShadows::Directional ? kRaised * voxel : 0;
}

glm::vec3 coneStart(const CachePlace& cache, ConeShadows shadows, float voxel) {
    const float raise = coneRaise(shadows, voxel);
    return shadows == ConeShadows::Directional ? cache.seenFrom(raise) : cache.raised(raise);
}

BlockCone coneOf(const CacheLightInput& input, const AreaLightBlock& block,
                 const CachePlace& cache) {
    const bool published = input.shadows == ConeShadows::Published;
    const float raise = coneRaise(input.shadows, input.voxels->lattice.cell);
    BlockCone cone{.from = coneStart(cache, input.shadows, input.voxels->lattice.cell),
                   .to = block.place + raise * block.normal};
    // The program takes the block's whole width for half of it.
    cone.sine = published ? block.width : block.width / 2;
    if (block.parallel)
        cone.sine /= std::max(glm::distance(cone.from, cone.to), cone.sine);
    cone.sine = std::min(cone.sine, kWidestSine);
    return cone;
}

float blockVisibility(const CacheLightInput& input, const AreaLightBlock& block,
                      const CachePlace& cache) {
    if (!input.voxels || input.shadows == ConeShadows::None)
        return 1;
    const Lattice& lattice = input.voxels->lattice;
    const BlockCone cone = coneOf(input, block, cache);
    return coneVisibility(*input.voxels, input.shadows, (cone.from - lattice.lower) / lattice.cell,
                          (cone.to - lattice.lower) / lattice.cell, cone.sine);
}

CacheLight lightCaches(std::span<const CachePlace> caches, const CacheLightInput& input,
                       const Progress& progress) {
    const std::size_t count = std::size_t(input.bands) * input.bands;
    const std::size_t texels = input.glossy ? input.glossy->texels() : 0;
    CacheLight light;
    light.harmonics.assign(caches.size() * count, glm::vec3(0));
    light.glossy.assign(caches.size() * texels, glm::vec3(0));
    const std::size_t groups = (caches.size() + kLanes - 1) / kLanes;
    std::vector<std::uint64_t> cones(groups, 0);
    parallelRanges(groups, 2, progress, "caches", [&](std::size_t begin, std::size_t end) {
        for (std::size_t g = begin; g < end; ++g) {
            const std::size_t first = g * kLanes, n = std::min(kLanes, caches.size() - first);
            const std::span<glm::vec3> harmonics(light.harmonics.data() + first * count, n * count);
            const std::span<glm::vec3> maps(light.glossy.data() + first * texels, n * texels);
            if (input.bands == 2)
                lightLanes<4>(caches.subspan(first, n), input, harmonics, maps, cones[g]);
            else
                lightLanes<9>(caches.subspan(first, n), input, harmonics, maps, cones[g]);
        }
    });
    if (input.voxels && input.shadows != ConeShadows::None)
        light.cones = std::accumulate(cones.begin(), cones.end(), std::uint64_t(0));
    return light;
}

void visitArrivals(const CacheLightInput& input, const CachePlace& cache,
                   const std::function<void(const Arrival&)>& visit) {
    const CacheLanes lanes(std::span(&cache, 1));
    ArrivalLanes a;
    for (std::uint32_t s = 0; s < input.lights.size(); ++s) {
        const AreaLights& lights = *input.lights[s].lights;
        for (const AreaLightBlock& block : lights.blocks) {
            if (!faces(lights, block, cache.position))
                continue;
            Lanes visible = {blockVisibility(input, block, cache)};
            for (std::uint32_t j = block.begin; j < block.end; ++j) {
                arrive(lanes, lights, j, visible, a);
                if (a.factor[0] > 0)
                    visit({s, j, {a.dx[0], a.dy[0], a.dz[0]}, a.factor[0]});
            }
        }
    }
}

} // namespace limn
