// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace limn {

/// Text of the file resources/export/`name`, which is compiled into the program. Precondition:
/// engine/export/CMakeLists.txt lists the file.
std::string_view exportResource(std::string_view name);

} // namespace limn
