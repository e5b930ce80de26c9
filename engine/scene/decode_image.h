// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/image.h"

#include <cstdint>
#include <span>

namespace limn {

/// Maximum number of texels: 16k x 16k, 1 GiB as RGBA. Larger images are rejected before anything
/// is allocated.
inline constexpr std::uint64_t kMaxTexels = std::uint64_t(1) << 28;

struct ImageSize {
    std::uint32_t width = 0, height = 0;
};

/// What the header of a PNG, JPEG, WebP or KTX2 (ktx2_image.h) says, whatever the file is called.
/// Fails on all else, and on sizes of zero or above kMaxTexels. Messages say what the image is or
/// does: "is too large".
Result<ImageSize> imageSize(std::span<const std::uint8_t> bytes);

/// Decodes a PNG, JPEG, WebP or KTX2 to RGBA. Of moving WebPs, none is read. Fails as imageSize()
/// does, and on damaged texels.
Result<Image> decodeImage(std::span<const std::uint8_t> bytes);

} // namespace limn
