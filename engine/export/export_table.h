// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"

#include <span>
#include <string>
#include <string_view>

namespace limn {

/// Every format that light is exported in.
std::span<const ExportFormat* const> exportFormats();

/// The format of that name, or null.
const ExportFormat* findExportFormat(std::string_view name);

/// Writes the files of an export. `path` names the main file, or for formats without extension a
/// folder, which is created. Each file replaces an old one atomically, the main file last, so that
/// an interrupted export leaves no main file that lacks its others. On failure, files that did not
/// exist before are removed again.
Result<void> writeExport(const std::string& path, const ExportFormat& format,
                         const std::vector<ExportFile>& files);

} // namespace limn
