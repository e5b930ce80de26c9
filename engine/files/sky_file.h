// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/scene/sky.h"

namespace limn {

/// Reads the panorama that `sky.image` names, .hdr or .exr. Pixels that are negative or NaN become
/// black. Fails with the file's name, also where it would not fit into memory, and leaves the sky
/// as it was.
Result<void> readSkyImage(Sky& sky, const MemoryBudget& memory = {});

} // namespace limn
