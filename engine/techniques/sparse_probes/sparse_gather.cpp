// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/sparse_gather.h"

#include "engine/core/parallel.h"
#include "engine/math/packing.h"
#include "engine/math/sh.h"
#include "engine/techniques/sparse_probes/relight_rays.h"

#include <algorithm>
#include <array>
#include <numbers>

#include <glm/common.hpp>

namespace limn {

namespace {

/// Adds weight times each of `count` values to the sums of three colours.
void addRow(const float* row, std::size_t count, glm::vec3 weight, float* sums) {
    for (std::size_t i = 0; i < count; ++i)
        sums[i] += weight.x * row[i];
    for (std::size_t i = 0; i < count; ++i)
        sums[count + i] += weight.y * row[i];
    for (std::size_t i = 0; i < count; ++i)
        sums[2 * count + i] += weight.z * row[i];
}

float solidAngle(const SparseBake& bake) {
    return 4 * std::numbers::pi_v<float> / float(bake.sparse.rays);
}

} // namespace

ProbeRadiance gatherSky(const SparseBake& bake, std::span<const glm::vec3> directions,
                        std::span<const float> basis, const Sky& sky) {
    const std::size_t count = bake.coefficients(), rays = bake.sparse.rays;
    std::vector<glm::vec3> radiance(rays);
    for (std::size_t q = 0; q < rays; ++q)
        radiance[q] = skyRadiance(sky, directions[q]) * solidAngle(bake);
    ProbeRadiance probes(bake.probes.size() * 3 * count, 0);
    parallelRanges(bake.probes.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p)
            for (std::size_t q = 0; q < rays; ++q)
                if (bake.hits[p * rays + q] == kSkyHit)
                    addRow(&basis[q * count], count, radiance[q], &probes[p * 3 * count]);
    });
    return probes;
}

void gatherProbes(const SparseBake& bake, std::span<const float> basis,
                  std::span<const glm::vec3> radiance, const ProbeRadiance& sky,
                  ProbeRadiance& probes) {
    const std::size_t count = bake.coefficients(), rays = bake.sparse.rays;
    const float share = solidAngle(bake);
    probes = sky;
    parallelRanges(bake.probes.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p)
            for (std::size_t q = 0; q < rays; ++q)
                if (const std::uint32_t hit = bake.hits[p * rays + q]; hit < kDarkHit)
                    addRow(&basis[q * count], count, radiance[hit] * share, &probes[p * 3 * count]);
    });
}

void gatherReceivers(const SparseBake& bake, const ProbeRadiance& probes, NotNegative clamped,
                     std::vector<glm::vec3>& irradiance) {
    const std::size_t count = bake.coefficients();
    const Transport& t = bake.transport;
    irradiance.resize(bake.receivers.size());
    if (!bake.compressed.empty()) {
        gatherCompressed(bake.compressed, count, probes, clamped, irradiance);
        return;
    }
    parallelRanges(irradiance.size(), 256, [&](std::size_t begin, std::size_t end) {
        std::array<float, kMaxCoefficients> row;
        for (std::size_t r = begin; r < end; ++r) {
            glm::vec3 sum(0);
            for (std::size_t k = r * kProbesPerReceiver; k < (r + 1) * kProbesPerReceiver; ++k) {
                if (t.probe[k] == kNoProbe)
                    break;
                const float* p = &probes[t.probe[k] * 3 * count];
                const std::uint16_t* halfs = &t.coefficients[k * count];
                for (std::size_t i = 0; i < count; ++i)
                    row[i] = halfToFloat(halfs[i]);
                glm::vec3 part(0);
                for (std::size_t i = 0; i < count; ++i)
                    part += row[i] * glm::vec3(p[i], p[count + i], p[2 * count + i]);
                sum += clamped == NotNegative::Parts ? glm::max(part, glm::vec3(0)) : part;
            }
            irradiance[r] = clamped == NotNegative::Nothing ? sum : glm::max(sum, glm::vec3(0));
        }
    });
}

void addTransposed(const SparseBake& bake, std::span<const glm::vec3> receivers,
                   std::span<glm::vec3> probes) {
    const std::size_t count = bake.coefficients();
    const Transport& t = bake.transport;
    if (!bake.compressed.empty()) {
        addTransposed(bake.compressed, count, receivers, probes);
        return;
    }
    for (std::size_t r = 0; r < receivers.size(); ++r) {
        if (receivers[r] == glm::vec3(0))
            continue;
        for (std::size_t k = r * kProbesPerReceiver; k < (r + 1) * kProbesPerReceiver; ++k) {
            if (t.probe[k] == kNoProbe)
                break;
            for (std::size_t i = 0; i < count; ++i)
                probes[t.probe[k] * count + i] +=
                    receivers[r] * halfToFloat(t.coefficients[k * count + i]);
        }
    }
}

glm::vec3 cellCentre(const IndirectField& field, std::uint32_t cell) {
    const glm::uvec3 size = field.gridSize,
                     coordinates(cell % size.x, cell / size.x % size.y, cell / size.x / size.y);
    return field.gridBounds.lower +
           (glm::vec3(coordinates) + 0.5f) * field.gridBounds.size() / glm::vec3(size);
}

void fillGrid(const SparseBake& bake, const ProbeRadiance& probes, IndirectField& field) {
    const std::size_t count = bake.coefficients(), cells = field.cells(),
                      common = std::min<std::size_t>(count, field.coefficients());
    field.grid.assign(cells * field.coefficients(), glm::vec4(0));
    parallelRanges(cells, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            const NearProbes near = nearestProbes(bake.probes, cellCentre(field, std::uint32_t(c)));
            float sum = 0;
            for (const float w : near.weight)
                sum += w;
            for (std::uint32_t k = 0; k < kProbesPerReceiver && near.probe[k] != kNoProbe; ++k) {
                const float* p = &probes[near.probe[k] * 3 * count];
                for (std::size_t i = 0; i < common; ++i)
                    field.grid[i * cells + c] +=
                        near.weight[k] / sum * glm::vec4(p[i], p[count + i], p[2 * count + i], 0);
            }
        }
    });
}

} // namespace limn
