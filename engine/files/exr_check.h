// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <span>

namespace limn {

/// Whether an OpenEXR file is what tinyexr 1.0 may be given: single-part scan lines whose
/// attributes, window and chunks lie within the file. tinyexr trusts them and reads or writes out
/// of bounds where they do not. The message names the attribute at fault.
Result<void> checkExr(std::span<const std::uint8_t> file);

} // namespace limn
