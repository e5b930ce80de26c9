// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/techniques/illuminance/bake/bake.h"

#include <string>

namespace limn {

/// `.limnbake`: versioned chunks with length and checksum, zstd inside. Written to a temporary file
/// and renamed.
Result<void> writeBake(const std::string& path, const Bake& bake);

/// Fails, naming the chunk, on a damaged, truncated or newer file, on one that would need more than
/// `memory`, and on one that cannot be followed safely (bakeDefect() without a scene: whoever
/// lights a scene by it asks again). What loads equals what was written.
Result<Bake> readBake(const std::string& path, const MemoryBudget& memory = {});

} // namespace limn
