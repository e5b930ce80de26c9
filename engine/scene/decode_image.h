// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/image.h"

#include <cstdint>
#include <span>

namespace limn {

/// 16k x 16k texels, 1 GiB as RGBA: larger images are refused before anything is allocated.
inline constexpr std::uint64_t kMaxTexels = std::uint64_t(1) << 28;

struct ImageSize {
    std::uint32_t width = 0, height = 0;
};

/// What the header of a PNG or JPEG says, whatever the file is called. Fails on all else, and on
/// sizes of zero or above kMaxTexels. Messages say what the image is or does: "is too large".
Result<ImageSize> imageSize(std::span<const std::uint8_t> bytes);

/// The texels of a PNG or JPEG, as RGBA; fails as imageSize() and where they are damaged.
Result<Image> decodeImage(std::span<const std::uint8_t> bytes);

} // namespace limn
