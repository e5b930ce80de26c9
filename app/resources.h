// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace limn {

/// Folder of what the program reads at run time: "resources" (icons) or "projects" (samples).
/// Returns share/limn/NAME beside the folder of an installed program, else NAME in the source tree
/// that the program was built from. It need not exist.
std::string dataFolder(const std::string& name);

/// Folder of the runtime for the web: share/limn/web of an installed program, else build/web in the
/// source tree. It need not exist.
std::string webRuntimeFolder();

} // namespace limn
