// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/splat_part.h"

#include "engine/field/sample_field.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

PhotonSplatPart::PhotonSplatPart(std::vector<Splat> splats, float radius)
    : m_splats(std::move(splats)), m_radius(radius) {
    m_order.reserve(m_splats.size());
    for (std::uint32_t i = 0; i < m_splats.size(); ++i)
        m_order.emplace_back(keyOf(cellAt(m_splats[i].position)), i);
    std::ranges::sort(m_order);
}

glm::ivec3 PhotonSplatPart::cellAt(glm::vec3 p) const {
    constexpr float kMaximum = float(1 << 20) - 2; // keys have 21 bits for each axis
    return glm::ivec3(glm::clamp(glm::floor(p / m_radius), -kMaximum, kMaximum));
}

std::uint64_t PhotonSplatPart::keyOf(glm::ivec3 cell) const {
    const glm::uvec3 c(cell + (1 << 20));
    return std::uint64_t(c.x) | std::uint64_t(c.y) << 21 | std::uint64_t(c.z) << 42;
}

void PhotonSplatPart::addTaps(const FieldPoint& point, float scale, FieldTaps& taps) const {
    const float weight = scale / (glm::pi<float>() * m_radius * m_radius);
    const glm::vec3 n = point.surfaceNormal();
    const glm::ivec3 middle = cellAt(point.position);
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y) {
            // Three cells along x have numbers in a row.
            const std::uint64_t first = keyOf(middle + glm::ivec3(-1, y, z)), last = first + 2;
            auto it = std::ranges::lower_bound(m_order, std::pair{first, 0U});
            for (; it != m_order.end() && it->first <= last; ++it) {
                const Splat& splat = m_splats[it->second];
                const glm::vec3 way = splat.position - point.position;
                if (glm::dot(way, way) <= m_radius * m_radius &&
                    glm::dot(splat.normal, n) >= kMinCosine)
                    taps.push_back({it->second, weight});
            }
        }
}

void PhotonSplatPart::irradianceTaps(const FieldPoint& point, FieldTaps& taps) const {
    addTaps(point, 1, taps);
}

void PhotonSplatPart::radianceTaps(const FieldPoint& point, glm::vec3 /*direction*/,
                                   FieldTaps& taps) const {
    addTaps(point, 1 / glm::pi<float>(), taps);
}

void PhotonSplatPart::lobeTaps(const FieldPoint& point, glm::vec3 /*direction*/, int /*bands*/,
                               const std::array<float, kMaxBands>& /*factors*/,
                               FieldTaps& taps) const {
    addTaps(point, 1 / glm::pi<float>(), taps);
}

glm::vec3 PhotonSplatPart::sum(std::span<const FieldTap> taps) const {
    glm::vec3 sum(0);
    for (const FieldTap& tap : taps)
        sum += tap.weight * m_splats[tap.index].power;
    return sum;
}

bool PhotonSplatPart::equals(const FieldPart& other) const {
    const auto* part = dynamic_cast<const PhotonSplatPart*>(&other);
    return part && part->m_splats == m_splats && part->m_radius == m_radius;
}

} // namespace limn
