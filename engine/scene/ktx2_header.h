// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

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

/// Behind the words, two longs for global supercompression data; then the index of the levels, the
/// finest first.
inline constexpr std::uint32_t kKtx2LevelIndex = 12 + 4 * kKtx2Words + 16;
inline constexpr std::uint32_t kKtx2Header = kKtx2LevelIndex + 24;
inline constexpr std::uint32_t kKtx2Zstd = 2; ///< supercompression scheme

} // namespace limn
