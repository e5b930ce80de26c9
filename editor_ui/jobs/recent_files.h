// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace limn {

/// Files opened lately, newest first, from $XDG_CONFIG_HOME/limn/recent (else ~/.config). Empty
/// where there is none.
std::vector<std::string> readRecentFiles();

/// `recent` with `path` first, at most ten, without repeats; written back, in silence where that
/// fails.
std::vector<std::string> addRecentFile(std::vector<std::string> recent, const std::string& path);

} // namespace limn
