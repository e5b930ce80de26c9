// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

// Textures of light in the container KTX 2.0 (The Khronos Group. KTX File Format Specification.
// Version 2.0), with one mip level, described after the Khronos Data Format Specification 1.3.

/// Formats of texels; the values are Vulkan's.
enum class Ktx2Format : std::uint32_t {
    Rgba16f = 97,  ///< VK_FORMAT_R16G16B16A16_SFLOAT
    Rgba32f = 109, ///< VK_FORMAT_R32G32B32A32_SFLOAT
    Rgb9e5 = 123,  ///< VK_FORMAT_E5B9G9R9_UFLOAT_PACK32
    /// VK_FORMAT_BC6H_UFLOAT_BLOCK, without negative values. As in all formats of blocks, what lies
    /// beyond the right or lower edge repeats it.
    Bc6hUnsigned = 143,
    Bc6hSigned = 144, ///< VK_FORMAT_BC6H_SFLOAT_BLOCK
};

/// Texels along a side of the blocks that a format consists of; 1: single texels.
std::uint32_t ktx2BlockSide(Ktx2Format format);
/// Bytes of a block.
std::uint32_t ktx2BlockBytes(Ktx2Format format);

/// Shape of a texture. At most one of `layers` and `depth` is not 0.
struct Ktx2Shape {
    Ktx2Format format = Ktx2Format::Rgba16f;
    std::uint32_t width = 1, height = 1; ///< [texels]
    std::uint32_t layers = 0;            ///< of an array; 0: not an array
    std::uint32_t depth = 0;             ///< slices of a 3D texture; 0: not 3D
    bool zstd = false;                   ///< the texels are compressed with Zstandard

    /// Number of layers or slices, at least 1.
    std::uint64_t images() const { return depth > 0 ? depth : layers > 0 ? layers : 1; }
    /// Number of texels in all of them.
    std::uint64_t texels() const { return std::uint64_t(width) * height * images(); }
    /// Their bytes, not compressed with Zstandard.
    std::uint64_t bytes() const {
        const std::uint32_t side = ktx2BlockSide(format);
        const std::uint64_t columns = (width + side - 1) / side, rows = (height + side - 1) / side;
        return images() * columns * rows * ktx2BlockBytes(format);
    }
    bool operator==(const Ktx2Shape&) const = default;
};

/// Encodes texels, x fastest, then y from the top row down, then layers or slices. There must be
/// shape.texels() of them. Half floats are rounded to nearest even and clamped to +-65504; Rgb9e5
/// as by packRgb9e5(), without alpha; blocks as by encodeBc6h(), on all cores. NaN becomes 0. Fails
/// on an empty texture, one that is both an array and 3D, and where memory is short.
Result<std::string> encodeKtx2(const Ktx2Shape& shape, std::span<const glm::vec4> texels);

/// Same with an alpha of 1.
Result<std::string> encodeKtx2(const Ktx2Shape& shape, std::span<const glm::vec3> texels);

/// A texture that was read, in the order of encodeKtx2(); alpha is 1 where a format has none.
struct Ktx2Texture {
    Ktx2Shape shape;
    std::vector<glm::vec4> texels; ///< finite
};

/// Shape of a KTX2 file. Checks all that precedes the texels: sizes, offsets, data format
/// descriptor, key/value data and the level. Accepts what encodeKtx2() writes, with any keys
/// besides an orientation, which must be top down, and refuses every other kind of texture.
/// Messages follow the file's name.
Result<Ktx2Shape> readKtx2Shape(std::span<const std::uint8_t> file);

/// Decodes a KTX2 file. Fails, before allocating, on a texture that needs more than `memory`.
/// Texels that are infinite or NaN are refused.
Result<Ktx2Texture> decodeKtx2(std::span<const std::uint8_t> file, const MemoryBudget& memory = {});

} // namespace limn
