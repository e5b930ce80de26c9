// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/scene/image.h"

#include <cstdint>
#include <span>
#include <string>

namespace limn {

/// Whether the file begins with the magic number of OpenEXR.
bool isExr(std::span<const std::uint8_t> file);

/// Decodes the first part of an OpenEXR file that has the channels R, G and B, or Y, in scan lines
/// or in tiles, of which the finest level counts. The image is the display window; where the file
/// has no pixels it is black. Colours of other primaries (`chromaticities`) become Rec. 709. Fails
/// on deep and damaged files, on whole numbers, on subsampled channels, and, before allocating, on
/// files that need more than `memory`. Messages follow the file's name and begin with the
/// attribute: "channels: there is no R".
Result<ImageF> decodeExr(std::span<const std::uint8_t> file, const MemoryBudget& memory);

/// The bytes of an OpenEXR file of 32-bit floats, ZIP, row 0 at the top.
Result<std::string> encodeExr(const ImageF& image);

} // namespace limn
