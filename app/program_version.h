// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace limn {

/// What `limn --version` prints: the versions of the program and of its bakers.
std::string programVersion();

} // namespace limn
