// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/bake.h"
#include "engine/core/result.h"

#include <string>

namespace limn {

/// `.limnbake`: versioned chunks with length and checksum, zstd inside. Written to a temporary file
/// and renamed.
Result<void> writeBake(const std::string& path, const Bake& bake);

/// Fails, naming the chunk, on a damaged, truncated or newer file. What loads equals what was
/// written.
Result<Bake> readBake(const std::string& path);

} // namespace limn
