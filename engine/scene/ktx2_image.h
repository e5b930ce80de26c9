// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/decode_image.h"

#include <cstdint>
#include <span>
#include <vector>

namespace limn {

/// Whether the file begins as KTX 2 files do.
bool isKtx2(std::span<const std::uint8_t> bytes);

/// A KTX2 file of one colour picture: 8 bits a channel, or blocks of BC1 to BC3, with Zstandard or
/// without; of its mip levels, the finest is read. The Khronos Group. KTX File Format
/// Specification. Version 2.0
struct Ktx2Picture {
    ImageSize size;
    std::uint32_t format = 0; ///< Vulkan's number
    bool isPacked = false;    ///< by Zstandard
    std::span<const std::uint8_t> stored;
    std::uint64_t bytes = 0; ///< of `stored` once unpacked
};

/// Reads all but the texels. Fails on what is damaged, and on what is not read, by name: cubes,
/// arrays, floats, Basis Universal, ETC, ASTC. Messages say what the image is: "is KTX2 of ETC2,
/// which is not read".
Result<Ktx2Picture> readKtx2Picture(std::span<const std::uint8_t> bytes);

/// Decodes the texels to `rgba`, which has the picture's size. Without alpha it is 255; of one
/// channel, all three have it. False if they are damaged.
bool decodeKtx2Picture(const Ktx2Picture& picture, std::vector<std::uint8_t>& rgba);

} // namespace limn
