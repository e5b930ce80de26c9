// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/field/sample_field.h"
#include "engine/math/sh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace limn {

/// A value that is linear in a field's coefficients, such as the bounced light of a pixel: for each
/// colour the sum, over entries and coefficients, of weight times coefficient.
struct FieldReading {
    struct Entry {
        bool grid = false;       ///< a cell of the grid, else a texel of the lightmap
        std::uint32_t index = 0; ///< of that cell or texel
        /// Per coefficient and colour; 0 from the field's number of coefficients on.
        std::array<glm::vec3, kMaxCoefficients> weight{};
    };
    std::vector<Entry> entries; ///< each cell and texel at most once
};

/// Adds weight * sampleIrradiance(at) to the reading. Where a colour of that is clamped to 0, it
/// adds nothing.
void addIrradiance(const FieldPoint& at, glm::vec3 weight, FieldReading& reading);

/// Adds weight * sampleLobe(at, direction, bands, factors), with the same exception.
void addLobe(const FieldPoint& at, glm::vec3 direction, int bands,
             const std::array<float, kMaxBands>& factors, glm::vec3 weight, FieldReading& reading);

/// The reading's value in `field`, which has the sizes of those it was made from.
glm::vec3 valueOf(const FieldReading& reading, const IndirectField& field);

} // namespace limn
