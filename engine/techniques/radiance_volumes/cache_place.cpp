// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/cache_place.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kMinAgreement = 0.25f; // length of the mean of unit normals

void addTo(std::int64_t& sum, float value) {
    std::atomic_ref(sum).fetch_add(std::int64_t(std::lround(value)), std::memory_order_relaxed);
}

} // namespace

glm::vec3 CachePlace::raised(float minHeight) const {
    const float agreement = glm::length(normal);
    if (agreement < kMinAgreement || height >= minHeight)
        return position;
    // A step along the mean normal raises it by the normals' mean cosine with that, `agreement`.
    return position + normal * ((minHeight - height) / (agreement * agreement));
}

glm::vec3 CachePlace::seenFrom(float minHeight) const {
    if (glm::length(normal) < kMinAgreement)
        return position;
    const CachePlace middle{
        .position = position + shift, .normal = normal, .height = height + glm::dot(shift, normal)};
    return middle.raised(std::max(minHeight, height));
}

void CachePlaceSums::add(std::size_t cache, glm::vec3 position, float cell, glm::vec3 p,
                         glm::vec3 normal) {
    PlaceSums& sums = m_sums[cache];
    addTo(sums.surfaces, 1);
    addTo(sums.x, normal.x * kPlaceUnit);
    addTo(sums.y, normal.y * kPlaceUnit);
    addTo(sums.z, normal.z * kPlaceUnit);
    const glm::vec3 shift = (p - position) / cell * kPlaceUnit;
    addTo(sums.shiftX, shift.x);
    addTo(sums.shiftY, shift.y);
    addTo(sums.shiftZ, shift.z);
    addTo(sums.height, glm::dot(position - p, normal) / cell * kPlaceUnit);
}

CachePlace placeOf(const PlaceSums& sums, glm::vec3 position, float cell) {
    CachePlace place{.position = position};
    if (sums.surfaces > 0) {
        const double unit = 1 / (double(kPlaceUnit) * double(sums.surfaces));
        place.normal = glm::vec3(glm::dvec3(sums.x, sums.y, sums.z) * unit);
        place.shift = glm::vec3(glm::dvec3(sums.shiftX, sums.shiftY, sums.shiftZ) * unit) * cell;
        place.height = float(double(sums.height) * unit) * cell;
    }
    return place;
}

} // namespace limn
