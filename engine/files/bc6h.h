// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

namespace limn {

// BC6H, textures of half floats in 8 bits a texel (Khronos Data Format Specification 1.3, chapter
// "BPTC Compressed Texture Image Formats"). A block has 4 x 4 texels, x first, then y from the top
// row down.

using Bc6hBlock = std::array<std::uint8_t, 16>;
using Bc6hTexels = std::array<glm::vec3, 16>;

/// Whether a texture holds negative values. Where it does not, they are encoded as 0.
enum class Bc6hSign : std::uint8_t { Unsigned, Signed };

/// Texels of a block. All are finite but for the signed -infinity, which the format can hold and
/// which becomes -65504. Blocks of reserved modes are black.
Bc6hTexels decodeBc6h(const Bc6hBlock& block, Bc6hSign sign);

/// The best of all modes, judged by the squared error of the halfs' bits, which is about that of
/// logarithms: one region with lines of 16 colours, and the four partitions into two regions of 8
/// that lines fit best. Values are clamped to +-65504; NaN becomes 0. A block of one half float's
/// value is exact.
Bc6hBlock encodeBc6h(const Bc6hTexels& texels, Bc6hSign sign);

} // namespace limn
