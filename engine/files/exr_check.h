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

/// Whether an OpenEXR file is what tinyexr 1.0 may be given: single-part scan lines whose
/// attributes, window and chunks lie within the file. tinyexr trusts them and reads or writes out
/// of bounds where they do not. No two chunks share bytes, and none has fewer than its lines can be
/// packed into, so that time and memory are bounded by the file's size. The tables of PIZ chunks
/// fit into them. tinyexr also reads up to kExrPadding bytes past the end of a file whose codes are
/// damaged, which must be there. The message names the attribute at fault.
Result<ExrSize> checkExr(std::span<const std::uint8_t> file);

} // namespace limn
