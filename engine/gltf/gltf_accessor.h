// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tiny_gltf.h>

namespace limn {

/// An accessor without a view is all zeros and costs its file nothing: of more, which no mesh
/// needs, none is read.
inline constexpr std::size_t kMaxZeros = std::size_t(1) << 20;

/// An accessor's numbers, row after row. Normalised integers become [0, 1] or [-1, 1], others plain
/// numbers; sparse values are applied. May hold NaN and infinity.
struct AccessorValues {
    std::vector<float> values; ///< count * components
    std::uint32_t components = 1;

    std::size_t count() const { return values.size() / components; }
    std::span<const float> row(std::size_t i) const {
        return {&values[i * components], components};
    }
};

/// Fails, naming the accessor's field, where type or ranges do not fit its views and buffers.
Result<AccessorValues> readNumbers(const tinygltf::Model& model, int accessor);

/// Scalars of an unsigned integer type.
Result<std::vector<std::uint32_t>> readIndices(const tinygltf::Model& model, int accessor);

/// The bytes of a buffer view. Fails where it does not lie within its buffer.
Result<std::span<const std::uint8_t>> viewBytes(const tinygltf::Model& model, int bufferView);

} // namespace limn
