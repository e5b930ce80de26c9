// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace limn {

/// Absolute path of a file or folder of the project; `inside` starts at its root, as in "projects".
/// Only source_path.cpp is compiled with the root, so that the object files of all tests are the
/// same in every checkout, and a compiler cache shares them.
std::string sourcePath(const std::string& inside);

} // namespace limn
