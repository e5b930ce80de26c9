// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <string>

namespace limn {

/// Writes `bytes` to a temporary file beside `path`, syncs it and renames it: either the old file
/// or the new one is there, whenever the machine stops. Follows a symbolic link.
Result<void> replaceFile(const std::string& path, const std::string& bytes);

} // namespace limn
