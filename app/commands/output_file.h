// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <initializer_list>
#include <string>

namespace limn {

/// Whether a file can be written at `path`, asked before the work whose result goes there: its
/// folder exists and may be written to, its name ends in one of `extensions`, and it is none of
/// `inputs`, by whatever name or link. What is there already must be a regular file, empty or of
/// the format that its extension names. Writes nothing.
Result<void> checkOutputFile(const std::string& path, std::initializer_list<const char*> extensions,
                             std::initializer_list<std::string> inputs = {});

} // namespace limn
