// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tiny_gltf.h>

namespace limn {

/// Maximum size of an accessor without a view, which is all zeros and takes no space in the file.
/// Larger ones, which no mesh needs, are rejected.
inline constexpr std::size_t kMaxZeros = std::size_t(1) << 20;

/// Values of an accessor, row after row. Normalised integers become [0, 1] or [-1, 1], others plain
/// numbers; sparse values are applied. May contain NaN and infinity.
struct AccessorValues {
    std::vector<float> values; ///< count * components
    std::uint32_t components = 1;

    std::size_t count() const { return values.size() / components; }
    std::span<const float> row(std::size_t i) const {
        return {&values[i * components], components};
    }
};

/// Reads an accessor. Fails, naming the accessor's field, if its type or ranges do not fit its
/// views and buffers.
Result<AccessorValues> readNumbers(const tinygltf::Model& model, int accessor);

/// The same for some of its rows, in ascending order. Primitives may share an accessor of which
/// each uses a few rows.
Result<AccessorValues> readNumbers(const tinygltf::Model& model, int accessor,
                                   std::span<const std::uint32_t> rows);

/// Number of elements of an accessor. Fails as readNumbers() does where they do not fit.
Result<std::size_t> countOfAccessor(const tinygltf::Model& model, int accessor);

/// Reads scalars of an unsigned integer type.
Result<std::vector<std::uint32_t>> readIndices(const tinygltf::Model& model, int accessor);

/// Bytes of a buffer view. Fails if it does not lie within its buffer.
Result<std::span<const std::uint8_t>> viewBytes(const tinygltf::Model& model, int bufferView);

} // namespace limn
