// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace limn {

/// Writes a line for people to stderr; stdout is reserved for results.
void logInfo(std::string_view message);
void logWarning(std::string_view message);
void logError(std::string_view message);

} // namespace limn
