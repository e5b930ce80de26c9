// SPDX-License-Identifier: MIT
#include "engine/field/field_reading.h"

#include "engine/math/hemisphere_radiance.h"
#include "engine/math/horizon.h"

#include <algorithm>
#include <span>

namespace limn {

/// Adds the sum of `ofCoefficients` times the coefficients of the light above the surface, where
/// `value` of that is above 0. Changes `ofCoefficients`.
static void addSum(const FieldPoint& point, std::span<float> ofCoefficients, glm::vec3 value,
                   glm::vec3 weight, FieldReading& reading) {
    for (int k = 0; k < 3; ++k)
        weight[k] = value[k] > 0 ? weight[k] : 0;
    const FieldLookup lookup = lookUp(point);
    if (point.field.continues && !lookup.grid)
        weighCut(point.surfaceNormal(), ofCoefficients.data());
    for (std::size_t k = 0; k < lookup.count; ++k) {
        const std::uint64_t key = std::uint64_t(lookup.index[k]) << 1 | (lookup.grid ? 1 : 0);
        const auto [place, added] = reading.places.try_emplace(key, reading.entries.size());
        if (added)
            reading.entries.push_back({.grid = lookup.grid, .index = lookup.index[k]});
        FieldReading::Entry& entry = reading.entries[place->second];
        for (std::size_t i = 0; i < ofCoefficients.size(); ++i)
            entry.weight[i] += weight * (lookup.weight[k] * ofCoefficients[i]);
    }
}

/// The same for the harmonics in `direction`, times factors[l] for each band l.
static void addBands(const FieldPoint& point, glm::vec3 direction, int bands,
                     const std::array<float, kMaxBands>& factors, glm::vec3 value, glm::vec3 weight,
                     FieldReading& reading) {
    float basis[kMaxCoefficients];
    shBasis(bands, direction, basis);
    for (int l = 0, i = 0; l < bands; ++l)
        for (; i < (l + 1) * (l + 1); ++i)
            basis[i] *= factors[std::size_t(l)];
    addSum(point, {basis, std::size_t(bands * bands)}, value, weight, reading);
}

void addIrradiance(const FieldPoint& point, glm::vec3 weight, FieldReading& reading) {
    addBands(point, point.normal, std::min(int(point.field.bands), kIrradianceBands),
             irradianceFactors(), sampleIrradiance(point), weight, reading);
}

void addRadiance(const FieldPoint& point, glm::vec3 direction, glm::vec3 weight,
                 FieldReading& reading) {
    const int bands = std::min(int(point.field.bands), kIrradianceBands);
    float ofCoefficients[kIrradianceBands * kIrradianceBands];
    hemisphereRadianceWeights(bands, point.normal, direction, ofCoefficients);
    addSum(point, {ofCoefficients, std::size_t(bands * bands)}, sampleRadiance(point, direction),
           weight, reading);
}

void addLobe(const FieldPoint& point, glm::vec3 direction, int bands,
             const std::array<float, kMaxBands>& factors, glm::vec3 weight, FieldReading& reading) {
    addBands(point, direction, std::min(bands, int(point.field.bands)), factors,
             sampleLobe(point, direction, bands, factors), weight, reading);
}

glm::vec3 valueOf(const FieldReading& reading, const IndirectField& field) {
    glm::dvec3 value(0);
    for (const FieldReading::Entry& entry : reading.entries) {
        const std::vector<glm::vec4>& values = entry.grid ? field.grid : field.lightmap;
        const std::size_t stride = values.size() / field.coefficients();
        for (std::size_t i = 0; i < field.coefficients(); ++i)
            value += glm::dvec3(entry.weight[i] * glm::vec3(values[i * stride + entry.index]));
    }
    for (const FieldReading::Marched& m : reading.marched)
        value += glm::dvec3(m.weight * marchedRadiance(*field.marched, m.lookup));
    return glm::vec3(value);
}

} // namespace limn
