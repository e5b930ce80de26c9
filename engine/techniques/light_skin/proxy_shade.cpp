// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/proxy_shade.h"

#include "engine/core/parallel.h"
#include "engine/math/sampling.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

static constexpr float kDiscPi = std::numbers::pi_v<float>;

float overlapOf(const DiscSquare& a, const DiscSquare& b) {
    const glm::vec2 d = glm::abs(a.centre - b.centre);
    const glm::vec2 shared =
        glm::min(glm::vec2((a.side + b.side) / 2) - d, glm::vec2(std::min(a.side, b.side)));
    return std::max(shared.x, 0.f) * std::max(shared.y, 0.f);
}

ShadingDiscs::ShadingDiscs(const LightCaches& caches) : m_caches(caches) {
    constexpr float kCellsOfSpacings = 6; // edge of a cell
    const float edge = kCellsOfSpacings * caches.spacing;
    std::map<std::uint64_t, std::vector<std::uint32_t>> byCell;
    const CubeRaster raster{edge};
    for (std::uint32_t c = 0; c < caches.size(); ++c)
        byCell[cubeKey(raster.cubeOf(caches.position[c]))].push_back(c);
    for (const auto& [key, discs] : byCell) {
        Cell cell{.first = std::uint32_t(m_discs.size()), .count = std::uint32_t(discs.size())};
        Bounds bounds = kNoBounds;
        for (const std::uint32_t c : discs) {
            extend(bounds, caches.position[c]);
            cell.largestArea = std::max(cell.largestArea, caches.area[c]);
        }
        cell.middle = bounds.centre();
        cell.radius = glm::length(bounds.size()) / 2;
        m_cells.push_back(cell);
        m_discs.insert(m_discs.end(), discs.begin(), discs.end());
    }
}

template <class Visit>
void ShadingDiscs::visitShaders(std::size_t c, const ProxyLight& proxy, const Visit& visit) const {
    const glm::vec3 here = m_caches.position[c], normal = m_caches.normal[c];
    const glm::vec3 way = proxy.position - here;
    const float r = glm::length(way), radius = proxy.radius();
    if (!(proxy.fluxOfLight > 0) || !(r > radius))
        return;
    const glm::mat3 toDisc = glm::transpose(basisAround(normal));
    const auto onDisc = [&](glm::vec3 direction) { return glm::vec2(toDisc * direction); };
    const float cosine = glm::dot(way, normal) / r;
    // A proxy without extent is a dot.
    const float factor = std::max(radius * radius / (r * r) * cosine, 1e-8f);
    const DiscSquare covered{onDisc(way / r), std::sqrt(kDiscPi * factor)};
    const float reach = r - radius;
    for (const Cell& cell : m_cells) {
        const glm::vec3 toCell = cell.middle - here;
        const float distance = glm::length(toCell), nearest = distance - cell.radius;
        if (nearest >= reach)
            continue;
        if (nearest > 0) {
            // All directions to the cell lie within asin(radius / distance) of that to its middle,
            // and their places on the disc within the chord of that angle.
            const float largest = std::sqrt(kDiscPi * cell.largestArea /
                                            (cell.largestArea + kDiscPi * nearest * nearest));
            const float chord = 2 * std::sin(std::asin(cell.radius / distance) / 2);
            const glm::vec2 d = glm::abs(onDisc(toCell / distance) - covered.centre);
            if (std::max(d.x, d.y) > (covered.side + largest) / 2 + chord + 1e-5f)
                continue;
        }
        for (std::uint32_t k = cell.first; k < cell.first + cell.count; ++k) {
            const std::uint32_t other = m_discs[k];
            const glm::vec3 d = m_caches.position[other] - here;
            const float up = glm::dot(d, normal), facing = -glm::dot(d, m_caches.normal[other]);
            if (!(up > 0) || !(facing > 0) || other == c)
                continue;
            const float d2 = glm::dot(d, d), area = m_caches.area[other];
            const float ofDisc = area * up * facing / (d2 * (area + kDiscPi * d2));
            if (ofDisc < kMinShadingFactor || !(d2 < reach * reach))
                continue;
            const float shared =
                overlapOf(covered, {onDisc(d / std::sqrt(d2)), std::sqrt(kDiscPi * ofDisc)});
            if (shared > 0)
                visit(other, shared / (covered.side * covered.side));
        }
    }
}

float ShadingDiscs::shadeOf(std::size_t c, const ProxyLight& proxy) const {
    float sum = 0;
    visitShaders(c, proxy, [&](std::uint32_t, float share) { sum += share; });
    return std::min(sum, 1.f);
}

std::vector<ShadingDiscs::Shader> ShadingDiscs::shadersOf(std::size_t c,
                                                          const ProxyLight& proxy) const {
    std::vector<Shader> shaders;
    visitShaders(c, proxy, [&](std::uint32_t other, float share) {
        shaders.push_back({other, share});
    });
    return shaders;
}

std::uint64_t ShadingDiscs::bytes() const {
    return m_cells.size() * sizeof(Cell) + m_discs.size() * sizeof(std::uint32_t);
}

void shadeProxies(const LightCaches& caches, const ShadingDiscs& discs,
                  std::span<CacheProxies> proxies, const Progress& progress) {
    parallelRanges(caches.size(), 16, progress, "shade of caches",
                   [&](std::size_t begin, std::size_t end) {
                       for (std::size_t c = begin; c < end; ++c)
                           for (ProxyLight* proxy : {&proxies[c].diffuse, &proxies[c].glossy})
                               proxy->lit = 1 - discs.shadeOf(c, *proxy);
                   });
}

} // namespace limn
