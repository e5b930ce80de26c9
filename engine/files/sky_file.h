// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/sky.h"

namespace limn {

/// Reads the panorama that `sky.image` names, .hdr or .exr. Pixels that are negative or no number
/// become black. Fails with the file's name and leaves the sky as it was.
Result<void> readSkyImage(Sky& sky);

} // namespace limn
