// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace limn {

struct ExrSize {
    std::uint32_t width = 0, height = 0; ///< [texels]
    std::uint32_t channels = 0;

    std::uint64_t texels() const { return std::uint64_t(width) * height; }
};

inline constexpr std::size_t kExrPadding = 1024;

/// Checks that an OpenEXR file is safe for tinyexr 1.0, which trusts the file and otherwise reads
/// or writes out of bounds. The file must have a single part of scan lines whose attributes, window
/// and chunks lie within the file. No two chunks may share bytes, and no chunk may be smaller than
/// its lines can be packed into, so that time and memory are bounded by the file's size. The tables
/// of PIZ chunks must fit into their chunks. tinyexr also reads up to kExrPadding bytes past the
/// end of a file whose codes are damaged; the caller must provide them. The message names the
/// invalid attribute.
Result<ExrSize> checkExr(std::span<const std::uint8_t> file);

} // namespace limn
