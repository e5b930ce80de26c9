// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <string>

namespace limn {

/// The bytes of the regular file at `path`, symbolic links followed. Fails on whatever may never
/// end or wait for somebody, such as a pipe or a device, and on more than `most` bytes, before it
/// reads any. Messages are what follows the file's name: "no such file", "not a regular file".
Result<std::string> readFile(const std::string& path, std::uint64_t most = std::uint64_t(1) << 36);

} // namespace limn
