// SPDX-License-Identifier: MIT
#pragma once

#include "engine/files/bc6h.h"
#include "engine/files/ktx2.h"

#include <array>
#include <cstdint>
#include <string>

namespace limn {

/// What a KTX2 file begins with.
inline constexpr std::array<std::uint8_t, 12> kKtx2Identifier = {
    0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};

/// Words of 32 bits behind the identifier, in this order; all are little-endian.
enum Ktx2Word : std::uint32_t {
    kKtx2VkFormat,
    kKtx2TypeSize,
    kKtx2Width,
    kKtx2Height,
    kKtx2Depth,
    kKtx2Layers,
    kKtx2Faces,
    kKtx2Levels,
    kKtx2Supercompression,
    kKtx2DfdOffset,
    kKtx2DfdBytes,
    kKtx2KvdOffset,
    kKtx2KvdBytes,
    kKtx2Words
};

/// Behind the words, two longs for global supercompression data; then the index of the only level.
inline constexpr std::uint32_t kKtx2LevelIndex = 12 + 4 * kKtx2Words + 16;
inline constexpr std::uint32_t kKtx2Header = kKtx2LevelIndex + 24;
inline constexpr std::uint32_t kKtx2Zstd = 2; ///< supercompression scheme

/// Bytes of the scalars that a texel is made of.
std::uint32_t ktx2TypeSize(Ktx2Format format);

/// Whether blocks of a format hold negative values.
inline Bc6hSign bc6hSignOf(Ktx2Format format) {
    return format == Ktx2Format::Bc6hSigned ? Bc6hSign::Signed : Bc6hSign::Unsigned;
}

/// Data format descriptor of a format, with its total size in front. `sized`: the texels are not
/// supercompressed, so their size is part of the descriptor.
std::string ktx2Descriptor(Ktx2Format format, bool sized);

} // namespace limn
