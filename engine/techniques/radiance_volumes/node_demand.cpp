// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/node_demand.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kUnit = 1 << 12;         // of normals, and of heights in cells
constexpr float kLeastAgreement = 0.25f; // length of the mean of unit normals

void add(std::int64_t& sum, float value) {
    std::atomic_ref(sum).fetch_add(std::int64_t(std::lround(value)), std::memory_order_relaxed);
}

glm::uvec3 corner(glm::uvec3 cell, std::uint32_t k) {
    return cell + glm::uvec3(k & 1, k >> 1 & 1, k >> 2);
}

} // namespace

glm::vec3 CachePlace::raised(float least) const {
    const float agreement = glm::length(normal);
    if (agreement < kLeastAgreement || height >= least)
        return position;
    // A step along the mean normal raises it by the normals' mean cosine with that, `agreement`.
    return position + normal * ((least - height) / (agreement * agreement));
}

NodeDemand::NodeDemand(const CacheGrids& grids)
    : m_grids(grids), m_wanted(grids.nodes(), 0), m_sums(grids.nodes()) {
    for (std::size_t g = 0; g < grids.grids.size(); ++g)
        m_first.push_back(grids.firstNode(g));
}

void NodeDemand::want(std::size_t grid, glm::uvec3 cell) {
    for (std::uint32_t k = 0; k < 8; ++k)
        std::atomic_ref(m_wanted[m_first[grid] + m_grids.grids[grid].index(corner(cell, k))])
            .store(1, std::memory_order_relaxed);
}

void NodeDemand::want(std::size_t grid, glm::uvec3 cell, glm::vec3 p, glm::vec3 normal) {
    const CacheGrid& g = m_grids.grids[grid];
    want(grid, cell);
    for (std::uint32_t k = 0; k < 8; ++k) {
        const glm::uvec3 node = corner(cell, k);
        Sums& sums = m_sums[m_first[grid] + g.index(node)];
        add(sums.surfaces, 1);
        add(sums.x, normal.x * kUnit);
        add(sums.y, normal.y * kUnit);
        add(sums.z, normal.z * kUnit);
        add(sums.height, glm::dot(g.place(node) - p, normal) / g.cell * kUnit);
    }
}

bool NodeDemand::wanted(std::size_t grid, std::size_t node) const {
    return m_wanted[m_first[grid] + node] != 0;
}

std::size_t NodeDemand::count() const {
    return std::size_t(std::ranges::count(m_wanted, 1));
}

CachePlace NodeDemand::place(std::size_t grid, std::size_t node) const {
    const CacheGrid& g = m_grids.grids[grid];
    CachePlace place{.position = g.place(g.node(node))};
    const Sums& sums = m_sums[m_first[grid] + node];
    if (sums.surfaces > 0) {
        const double unit = 1 / (double(kUnit) * double(sums.surfaces));
        place.normal = glm::vec3(glm::dvec3(sums.x, sums.y, sums.z) * unit);
        place.height = float(double(sums.height) * unit) * g.cell;
    }
    return place;
}

} // namespace limn
