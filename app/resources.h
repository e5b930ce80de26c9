// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"

#include <string>

namespace limn {

/// Folder of what the program reads at run time: "resources" (icons, fonts) or "projects"
/// (samples). Returns share/limn/NAME beside the folder of an installed program, else NAME in the
/// source tree that the program was built from. It need not exist.
std::string dataFolder(const std::string& name);

/// Where exports find three.js and the runtime for the web: three.js in node_modules of the working
/// directory, else where ./run --web puts it; the runtime in share/limn/web of an installed
/// program, else in build/web of the source tree. Neither need exist.
ExportFolders exportFolders();

} // namespace limn
