// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <initializer_list>
#include <string>

namespace limn {

/// Whether a file can be written at `path`, asked before the work whose result goes there: its
/// folder exists and may be written to, it is no folder itself, and it ends in one of `extensions`
/// (none: any will do). Writes nothing.
Result<void> checkOutputFile(const std::string& path,
                             std::initializer_list<const char*> extensions = {});

} // namespace limn
