// SPDX-License-Identifier: MIT
#include "engine/field/field_reading.h"

#include "engine/math/hemisphere_radiance.h"
#include "engine/math/horizon.h"

#include <algorithm>
#include <span>

namespace limn {

/// The weight of a value that is clamped to 0 where it is negative.
static glm::vec3 clampedWeight(glm::vec3 value, glm::vec3 weight) {
    for (int k = 0; k < 3; ++k)
        weight[k] = value[k] > 0 ? weight[k] : 0;
    return weight;
}

/// Adds the sum of `ofCoefficients` times the coefficients of the light above the surface. Changes
/// `ofCoefficients`.
static void addSum(const FieldPoint& point, std::span<float> ofCoefficients, glm::vec3 weight,
                   FieldReading& reading) {
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
                     const std::array<float, kMaxBands>& factors, glm::vec3 weight,
                     FieldReading& reading) {
    float basis[kMaxCoefficients];
    shBasis(bands, direction, basis);
    for (int l = 0, i = 0; l < bands; ++l)
        for (; i < (l + 1) * (l + 1); ++i)
            basis[i] *= factors[std::size_t(l)];
    addSum(point, {basis, std::size_t(bands * bands)}, weight, reading);
}

/// Adds the numbers of a part.
static void addTapsOf(std::uint32_t part, const FieldTaps& taps, glm::vec3 weight,
                      FieldReading& reading) {
    for (const FieldTap& tap : taps) {
        const std::uint64_t key = std::uint64_t(part) << 32 | tap.index;
        const auto [place, added] = reading.partPlaces.try_emplace(key, reading.partNumbers.size());
        if (added)
            reading.partNumbers.push_back({part, tap.index});
        reading.partNumbers[place->second].weight += weight * tap.weight;
    }
}

/// Adds what the field's other parts contribute.
template <class AddTaps>
static void readParts(const FieldPoint& point, glm::vec3 weight, FieldReading& reading,
                      const AddTaps& addTaps) {
    FieldTaps taps;
    for (std::uint32_t k = 0; k < point.field.parts.size(); ++k) {
        taps.clear();
        addTaps(*point.field.parts[k], taps);
        addTapsOf(k, taps, weight, reading);
    }
}

void addIrradiance(const FieldPoint& point, glm::vec3 weight, FieldReading& reading) {
    weight = clampedWeight(sampleIrradiance(point), weight);
    addBands(point, point.normal, std::min(int(point.field.bands), kIrradianceBands),
             irradianceFactors(), weight, reading);
    readParts(point, weight, reading,
              [&](const FieldPart& part, FieldTaps& taps) { part.irradianceTaps(point, taps); });
}

void addRadiance(const FieldPoint& point, glm::vec3 direction, glm::vec3 weight,
                 FieldReading& reading) {
    const int bands = std::min(int(point.field.bands), kIrradianceBands);
    float ofCoefficients[kIrradianceBands * kIrradianceBands];
    hemisphereRadianceWeights(bands, point.normal, direction, ofCoefficients);
    weight = clampedWeight(sampleRadiance(point, direction), weight);
    addSum(point, {ofCoefficients, std::size_t(bands * bands)}, weight, reading);
    readParts(point, weight, reading, [&](const FieldPart& part, FieldTaps& taps) {
        part.radianceTaps(point, direction, taps);
    });
}

void addLobe(const FieldPoint& point, glm::vec3 direction, int bands,
             const std::array<float, kMaxBands>& factors, glm::vec3 weight, FieldReading& reading) {
    weight = clampedWeight(sampleLobe(point, direction, bands, factors), weight);
    addBands(point, direction, std::min(bands, int(point.field.bands)), factors, weight, reading);
    readParts(point, weight, reading, [&](const FieldPart& part, FieldTaps& taps) {
        part.lobeTaps(point, direction, bands, factors, taps);
    });
}

void addReflection(const IndirectField& field, const ReflectedLobe& lobe, glm::vec3 weight,
                   FieldReading& reading) {
    const auto reflecting =
        std::ranges::find_if(field.parts, [](const auto& part) { return part->reflects(); });
    FieldTaps taps;
    (*reflecting)->reflectionTaps(lobe, taps);
    addTapsOf(std::uint32_t(reflecting - field.parts.begin()), taps, weight, reading);
}

glm::vec3 valueOf(const FieldReading& reading, const IndirectField& field) {
    glm::dvec3 value(0);
    for (const FieldReading::Entry& entry : reading.entries) {
        const std::vector<glm::vec4>& values = entry.grid ? field.grid : field.lightmap;
        const std::size_t stride = values.size() / field.coefficients();
        for (std::size_t i = 0; i < field.coefficients(); ++i)
            value += glm::dvec3(entry.weight[i] * glm::vec3(values[i * stride + entry.index]));
    }
    for (const FieldReading::PartNumber& number : reading.partNumbers) {
        const FieldTap one{number.index, 1};
        value += glm::dvec3(number.weight * field.parts[number.part]->sum({&one, 1}));
    }
    return glm::vec3(value);
}

} // namespace limn
