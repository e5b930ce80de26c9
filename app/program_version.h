// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace limn {

/// What `limn --version` prints.
std::string programVersion();

} // namespace limn
