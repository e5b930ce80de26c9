// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <initializer_list>
#include <string>

namespace limn {

/// Whether a file can be written at `path`, asked before the work whose result goes there: its
/// folder exists and may be written to, it is a regular file if it is there at all, it ends in one
/// of `extensions`, and it holds nothing else, and it is none of the files that are read, by
/// whatever name or link. Writes nothing.
Result<void> checkOutputFile(const std::string& path, std::initializer_list<const char*> extensions,
                             std::initializer_list<std::string> inputs = {});

} // namespace limn
