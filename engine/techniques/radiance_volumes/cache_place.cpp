// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/cache_place.h"

#include <atomic>
#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kUnit = 1 << 12;         // of normals, and of heights in cells
constexpr float kLeastAgreement = 0.25f; // length of the mean of unit normals

void addTo(std::int64_t& sum, float value) {
    std::atomic_ref(sum).fetch_add(std::int64_t(std::lround(value)), std::memory_order_relaxed);
}

} // namespace

glm::vec3 CachePlace::raised(float least) const {
    const float agreement = glm::length(normal);
    if (agreement < kLeastAgreement || height >= least)
        return position;
    // A step along the mean normal raises it by the normals' mean cosine with that, `agreement`.
    return position + normal * ((least - height) / (agreement * agreement));
}

void CachePlaceSums::add(std::size_t cache, glm::vec3 position, float cell, glm::vec3 p,
                         glm::vec3 normal) {
    Sums& sums = m_sums[cache];
    addTo(sums.surfaces, 1);
    addTo(sums.x, normal.x * kUnit);
    addTo(sums.y, normal.y * kUnit);
    addTo(sums.z, normal.z * kUnit);
    addTo(sums.height, glm::dot(position - p, normal) / cell * kUnit);
}

CachePlace CachePlaceSums::place(std::size_t cache, glm::vec3 position, float cell) const {
    CachePlace place{.position = position};
    const Sums& sums = m_sums[cache];
    if (sums.surfaces > 0) {
        const double unit = 1 / (double(kUnit) * double(sums.surfaces));
        place.normal = glm::vec3(glm::dvec3(sums.x, sums.y, sums.z) * unit);
        place.height = float(double(sums.height) * unit) * cell;
    }
    return place;
}

} // namespace limn
