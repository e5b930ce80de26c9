// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/scene/image.h"

#include <cstdint>
#include <span>

namespace limn {

/// Whether the file begins with the header of a Radiance picture.
bool isHdr(std::span<const std::uint8_t> file);

/// Decodes a Radiance picture (.hdr) whose rows run from the top left, run-length encoded or not.
/// Fails on truncated files, and, before allocating, on files that need more than `memory`.
/// Messages follow the file's name: "malformed HDR".
/// Ward. Real Pixels. Graphics Gems II, 1991
Result<ImageF> decodeHdr(std::span<const std::uint8_t> file, const MemoryBudget& memory);

} // namespace limn
