// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace limn {

/// Recently opened files, newest first, from $XDG_CONFIG_HOME/limn/recent (else ~/.config). Empty
/// if there are none.
std::vector<std::string> readRecentFiles();

/// Returns `recent` with `path` first, without duplicates and at most ten long, and writes it back.
/// A failure to write is ignored.
std::vector<std::string> addRecentFile(std::vector<std::string> recent, const std::string& path);

} // namespace limn
