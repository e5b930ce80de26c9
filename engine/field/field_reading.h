// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/field/sample_field.h"
#include "engine/math/sh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace limn {

/// A value that is linear in a field's light, such as the bounced light of a pixel: for each colour
/// the sum, over entries and coefficients, of weight times coefficient, and that of the numbers of
/// the field's other parts.
struct FieldReading {
    struct Entry {
        bool grid = false;       ///< a cell of the grid, else a texel of the lightmap
        std::uint32_t index = 0; ///< of that cell or texel
        /// Per coefficient and colour; 0 from the field's number of coefficients on.
        std::array<glm::vec3, kMaxCoefficients> weight{};
    };
    std::vector<Entry> entries;                            ///< each cell and texel at most once
    std::unordered_map<std::uint64_t, std::size_t> places; ///< of entries, by index and `grid`

    /// Weights of the numbers that the field's other parts store, each number at most once.
    struct PartNumber {
        std::uint32_t part = 0;  ///< index into IndirectField::parts
        std::uint32_t index = 0; ///< as FieldTap::index
        glm::vec3 weight{0};
    };
    std::vector<PartNumber> partNumbers;
    std::unordered_map<std::uint64_t, std::size_t> partPlaces; ///< of those, by part and index

    /// The same as `entries`, of Lighting::emittedField().
    std::vector<Entry> emitted;
};

/// Adds weight * sampleIrradiance(point) to the reading. Where a colour of that is clamped to 0, it
/// adds nothing.
void addIrradiance(const FieldPoint& point, glm::vec3 weight, FieldReading& reading);

/// Adds weight * sampleRadiance(point, direction), with the same exception.
void addRadiance(const FieldPoint& point, glm::vec3 direction, glm::vec3 weight,
                 FieldReading& reading);

/// Adds weight * sampleLobe(point, direction, bands, factors), with the same exception.
void addLobe(const FieldPoint& point, glm::vec3 direction, int bands,
             const std::array<float, kMaxBands>& factors, glm::vec3 weight, FieldReading& reading);

/// Adds weight * sampleReflection(field, lobe) to the reading. Precondition: reflectingPart(field).
void addReflection(const IndirectField& field, const ReflectedLobe& lobe, glm::vec3 weight,
                   FieldReading& reading);

/// The reading's value in `field`, which has the sizes of those it was made from.
glm::vec3 valueOf(const FieldReading& reading, const IndirectField& field);

} // namespace limn
