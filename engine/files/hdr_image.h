// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/scene/image.h"

#include <cstdint>
#include <span>

namespace limn {

/// Whether the file begins as a Radiance picture does.
bool isHdr(std::span<const std::uint8_t> file);

/// The texels of a Radiance picture (.hdr) whose rows run from the top left, packed or plain. Fails
/// on a file that ends before they do, and on one that would need more than `memory` before it
/// allocates; messages are what follows the file's name: "malformed HDR".
/// Ward. Real Pixels. Graphics Gems II, 1991
Result<ImageF> decodeHdr(std::span<const std::uint8_t> file, const MemoryBudget& memory);

} // namespace limn
