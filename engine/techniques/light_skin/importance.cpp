// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/importance.h"

#include "engine/core/parallel.h"
#include "engine/math/luminance.h"
#include "engine/math/sampling.h"
#include "engine/techniques/light_skin/lanes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace limn {

std::vector<float> fluxLuminances(const VirtualLights& lights) {
    std::vector<float> all(lights.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = luminance(lights.fluxOf(i));
    return all;
}

std::vector<float> importances(const VirtualLights& lights, const ViewSamples& samples,
                               float nearest) {
    std::vector<float> result = fluxLuminances(lights);
    const float bound = nearest * nearest;
    parallelRanges(lights.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t first = begin; first < end; first += kSkinLanes) {
            const std::size_t count = std::min(kSkinLanes, end - first);
            Lanes p[3], n[3];
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] = loadLanes(lights.position[k], first, count);
                n[k] = loadLanes(lights.normal[k], first, count);
            }
            Lanes sum{};
            for (std::size_t v = 0; v < samples.size(); ++v) {
                const glm::vec3 x = samples.position[v], m = samples.normal[v];
                const Lanes dx = x.x - p[0], dy = x.y - p[1], dz = x.z - p[2];
                const Lanes l2 = dx * dx + dy * dy + dz * dz;
                const Lanes leaving = positive(n[0] * dx + n[1] * dy + n[2] * dz);
                const Lanes arriving = positive(-(m.x * dx + m.y * dy + m.z * dz));
                const Lanes bounded = l2 > bound ? l2 : Lanes{} + bound;
                sum += leaving * arriving / (notBelow(l2, 1e-30f) * bounded);
            }
            for (std::size_t i = 0; i < count; ++i)
                result[first + i] *= samples.size() == 0 ? 0 : sum[i] / float(samples.size());
        }
    });
    return result;
}

RasterSums::RasterSums(const VirtualLights& lights, std::span<const float> values)
    : m_columns(lights.columns), m_firstOfColumn(lights.columns + 1), m_within(lights.size()) {
    double all = 0;
    std::uint32_t next = 0;
    for (std::uint32_t column = 0; column < lights.columns; ++column) {
        m_firstOfColumn[column] = next;
        double sum = 0;
        for (; next < lights.size() && lights.cell[next] / lights.rows == column; ++next) {
            sum += double(values[next]);
            m_within[next] = sum;
        }
        all += sum;
        m_columns[column] = all;
    }
    m_firstOfColumn[lights.columns] = next;
}

std::uint32_t RasterSums::find(glm::dvec2 u) const {
    // The first column whose sum exceeds the place: columns without light are never found.
    const double place = std::min(u.x, 1 - 1e-15) * total();
    const auto column = std::size_t(std::min(std::ranges::upper_bound(m_columns, place),
                                             std::ranges::lower_bound(m_columns, total())) -
                                    m_columns.begin());
    const auto begin = m_within.begin() + m_firstOfColumn[column],
               end = m_within.begin() + m_firstOfColumn[column + 1];
    const double ofColumn = *(end - 1);
    const auto light = std::min(std::upper_bound(begin, end, std::min(u.y, 1 - 1e-15) * ofColumn),
                                std::lower_bound(begin, end, ofColumn));
    return std::uint32_t(light - m_within.begin());
}

std::uint64_t RasterSums::bytes() const {
    return (m_columns.size() + m_within.size()) * sizeof(double) +
           m_firstOfColumn.size() * sizeof(std::uint32_t);
}

ChosenLights allLights(const VirtualLights& lights) {
    ChosenLights all{std::vector<std::uint32_t>(lights.size()),
                     std::vector<float>(lights.size(), 1.f)};
    std::iota(all.light.begin(), all.light.end(), 0U);
    return all;
}

/// Point k of the sequence, shifted.
static glm::dvec2 haltonPoint(std::uint32_t k, glm::dvec2 shift) {
    const glm::dvec2 p =
        glm::dvec2(double(radicalInverse(k, 2)), double(radicalInverse(k, 3))) + shift;
    return p - glm::floor(p);
}

/// Draws of one kind: `count` from number `first` on.
struct DrawsOfKind {
    const RasterSums& sums;
    std::uint32_t first, count;

    /// Calls drawn(number, light) for those of a part.
    template <class Drawn>
    void each(DrawBlock part, glm::dvec2 shift, const Drawn& drawn) const {
        const auto upTo = [&](std::uint32_t block) {
            return std::uint32_t(std::uint64_t(count) * block / part.blocks);
        };
        for (std::uint32_t k = upTo(part.block); k < upTo(part.block + 1); ++k)
            drawn(first + k, sums.find(haltonPoint(k, shift)));
    }
};

void drawLights(const VirtualLights& lights, std::span<const float> importance,
                const ChoiceOptions& options, DrawBlock part, LightDraws& draws) {
    const std::uint32_t count = options.count;
    draws.cell.resize(count, 0);
    draws.weight.resize(count, 0);
    const std::vector<float> flux = fluxLuminances(lights);
    const RasterSums important(lights, importance), bright(lights, flux), wide(lights, lights.area);
    auto defensive = std::uint32_t(std::lround(double(options.defence) * count));
    if (!(important.total() > 0) && defensive > 0)
        defensive = count;
    if (!(bright.total() > 0) || (defensive == 0 && !(important.total() > 0))) {
        draws.weight.assign(count, 0);
        return;
    }
    const std::uint32_t byArea = defensive / 2, byFlux = defensive - byArea;
    // Shares of the draws as made, so that weights are exact.
    const auto drawn = [&](std::uint32_t k, std::uint32_t light) {
        double expected = byFlux * double(flux[light]) / bright.total(); // N P
        if (byArea > 0)
            expected += byArea * double(lights.area[light]) / wide.total();
        if (defensive < count)
            expected += (count - defensive) * double(importance[light]) / important.total();
        draws.cell[k] = lights.cell[light];
        draws.weight[k] = 1 / expected;
    };
    // Each kind of draw has a sequence of its own: of one sequence, every tenth point has the same
    // first digit.
    DrawsOfKind{important, 0, count - defensive}.each(part, options.shift, drawn);
    DrawsOfKind{bright, count - defensive, byFlux}.each(part, options.shift, drawn);
    DrawsOfKind{wide, count - byArea, byArea}.each(part, options.shift, drawn);
}

ChosenLights drawnLights(const VirtualLights& lights, const LightDraws& draws) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order; // cell, draw
    for (std::uint32_t k = 0; k < draws.cell.size(); ++k)
        if (draws.weight[k] > 0)
            order.emplace_back(draws.cell[k], k);
    std::ranges::sort(order);
    ChosenLights chosen;
    auto next = lights.cell.begin();
    for (std::size_t i = 0; i < order.size();) {
        const std::uint32_t cell = order[i].first;
        double weight = 0;
        for (; i < order.size() && order[i].first == cell; ++i)
            weight += draws.weight[order[i].second];
        next = std::lower_bound(next, lights.cell.end(), cell);
        if (next == lights.cell.end() || *next != cell)
            continue;
        chosen.light.push_back(std::uint32_t(next - lights.cell.begin()));
        chosen.weight.push_back(float(weight));
    }
    return chosen;
}

ChosenLights chooseLights(const VirtualLights& lights, std::span<const float> importance,
                          const ChoiceOptions& options) {
    if (lights.size() <= options.count)
        return allLights(lights);
    LightDraws draws;
    drawLights(lights, importance, options, {}, draws);
    return drawnLights(lights, draws);
}

} // namespace limn
