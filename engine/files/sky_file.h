// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/result.h"
#include "engine/scene/sky.h"

namespace limn {

/// Reads the panorama named by `sky.image`, .hdr or .exr. Where the name ends with kWithoutSun
/// (sky_sun.h), the sun is cut out of the file's pixels. Negative and NaN pixels become black.
/// Fails, with the file's name in the message, if it cannot be read or would not fit into memory;
/// the sky is then unchanged.
Result<void> readSkyImage(Sky& sky, const MemoryBudget& memory = {});

} // namespace limn
