// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace limn {

/// Lines for people, on stderr: stdout belongs to results.
void logInfo(std::string_view message);
void logWarning(std::string_view message);
void logError(std::string_view message);

} // namespace limn
