// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/techniques/illuminance/format/bake.h"

#include <string>

namespace limn {

/// First characters of the file of a bake.
inline constexpr const char* kBakeMark = "LIMNBAKE";

/// Writes a `.limnbake` file: versioned chunks with length and checksum, compressed by zstd. It is
/// written to a temporary file and renamed.
Result<void> writeBake(const std::string& path, const Bake& bake);

/// Reads a `.limnbake` file; the bake equals the one that was written. Fails, naming the chunk, on
/// a damaged, truncated or newer file, on one that would need more than `memory`, and on one that
/// is unsafe to use (bakeDefect() without a scene, so check again before lighting one).
Result<Bake> readBake(const std::string& path, const MemoryBudget& memory = {});

} // namespace limn
