// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/lit_volume.h"

#include "engine/math/sh.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

namespace limn {

namespace {

/// Weights of a cache's numbers in a reading.
struct CacheReading {
    std::array<glm::vec3, kIrradianceBands * kIrradianceBands> harmonics{};
    std::vector<glm::vec3> map; ///< all levels; empty: it is not read
};

std::map<std::uint32_t, CacheReading> byCache(const VolumePart& part, const FieldReading& reading) {
    std::map<std::uint32_t, CacheReading> caches;
    for (const FieldReading::PartNumber& number : reading.partNumbers) {
        const auto addHarmonic = [&](std::size_t index, glm::vec3 weight) {
            caches[std::uint32_t(index / part.coefficients())]
                .harmonics[index % part.coefficients()] += weight;
        };
        if (number.index < part.firstTexel()) {
            addHarmonic(number.index, number.weight);
            continue;
        }
        if (number.index >= part.firstColour()) {
            const std::size_t colour = number.index - part.firstColour();
            glm::vec3 weight(0);
            weight[int(colour % 3)] = number.weight[int(colour % 3)];
            addHarmonic(colour / 3, weight);
            continue;
        }
        const std::size_t texel = number.index - part.firstTexel();
        CacheReading& read = caches[std::uint32_t(texel / part.glossy->texels())];
        read.map.resize(part.glossy->texels(), glm::vec3(0));
        read.map[texel % part.glossy->texels()] += number.weight;
    }
    return caches;
}

/// The finest level of the map of a cache, before it is completed.
std::vector<glm::vec3> finestLevel(const CacheLightInput& input, const CachePlace& cache,
                                   const glm::mat3& frame) {
    std::vector<glm::vec3> finest(std::size_t(input.glossy->tile) * input.glossy->tile,
                                  glm::vec3(0));
    visitArrivals(input, cache, [&](const Arrival& a) {
        const LitAreaLights& lit = input.lights[a.source];
        const GlossySplat splat = glossySplat(*input.glossy, frame, a.direction);
        finest[splat.texel] += lit.lights->flux[a.light] * lit.colour * (a.factor * splat.factor);
    });
    return finest;
}

/// For each source, the value per flux of each of its area lights.
using Weights = std::vector<std::vector<glm::dvec3>>;

void addWeights(const CacheLightInput& input, const CachePlace& cache, const CacheReading& read,
                Weights& weights) {
    std::vector<glm::vec3> finest; // weights of texels
    glm::mat3 frame(1);
    if (!read.map.empty()) {
        frame = glossyFrame(input.eye - cache.position);
        finest = glossyAdjoint(*input.glossy, finestLevel(input, cache, frame), read.map);
    }
    visitArrivals(input, cache, [&](const Arrival& a) {
        float y[kIrradianceBands * kIrradianceBands];
        shBasis(int(input.bands), a.direction, y);
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < std::size_t(input.bands) * input.bands; ++i)
            sum += glm::dvec3(read.harmonics[i]) * double(y[i]);
        if (!finest.empty()) {
            const GlossySplat splat = glossySplat(*input.glossy, frame, a.direction);
            sum += glm::dvec3(finest[splat.texel]) * double(splat.factor);
        }
        weights[a.source][a.light] += sum * double(a.factor);
    });
}

} // namespace

std::vector<LitAreaLights> LitVolume::coloured() const {
    std::vector<LitAreaLights> all;
    for (std::size_t i = 0; i < sources.size(); ++i)
        all.push_back({lights[i].get(), sources[i].colour});
    return all;
}

CacheLightInput LitVolume::input(std::span<const LitAreaLights> coloured) const {
    return {.lights = coloured,
            .voxels = voxels.get(),
            .shadows = settings.shadow,
            .bands = settings.bands,
            .glossy = part ? part->glossy : std::optional<GlossyMapShape>(),
            .eye = part ? part->eye : glm::vec3(0)};
}

Explanation explainVolume(const LitVolume& lit, const Scene& scene, const FieldReading& reading,
                          const ExplainOptions& options) {
    const std::vector<LitAreaLights> coloured = lit.coloured();
    const CacheLightInput input = lit.input(coloured);
    Weights weights;
    for (const auto& lights : lit.lights)
        weights.emplace_back(lights->count(), glm::dvec3(0));
    for (const auto& [cache, read] : byCache(*lit.part, reading))
        addWeights(input, lit.part->caches->places[cache], read, weights);

    Explanation e{.bounces = 1};
    std::map<std::uint32_t, glm::dvec3> senders;
    for (std::size_t s = 0; s < lit.sources.size(); ++s) {
        glm::dvec3 sum(0);
        for (const AreaLights::Share& share : lit.lights[s]->shares) {
            if (std::ranges::find(options.black, share.instance) != options.black.end())
                continue;
            const glm::dvec3 value =
                weights[s][share.light] * glm::dvec3(share.flux * lit.sources[s].colour);
            sum += value;
            senders[share.instance] += value;
        }
        addRow(e.byOrigin, {.kind = LightRowKind::Light,
                            .label = scene.lights[lit.sources[s].index].name,
                            .index = lit.sources[s].index,
                            .value = glm::vec3(sum)});
    }
    if (!options.black.empty())
        return e;
    std::vector<LightRow> rows;
    for (const auto& [instance, value] : senders)
        rows.push_back({.kind = LightRowKind::Surface,
                        .label = objectLabel(scene, instance),
                        .index = instance,
                        .value = glm::vec3(value)});
    e.bySender = strongest(std::move(rows), options.rows);
    return e;
}

} // namespace limn
