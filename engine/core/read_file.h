// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <string>

namespace limn {

/// Reads the regular file at `path`, following symbolic links. Fails, before reading, on anything
/// that might never end or block, such as a pipe or a device, and on files of more than `maxBytes`
/// bytes. Messages follow the file's name: "no such file", "not a regular file".
Result<std::string> readFile(const std::string& path, std::uint64_t maxBytes = std::uint64_t(1)
                                                                               << 36);

} // namespace limn
