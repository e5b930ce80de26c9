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

/// Checks that `path` has one of the format's extensions, or for a format without extension that it
/// is a folder or nothing.
Result<void> checkExportPath(const std::string& path, const ExportFormat& format);

/// A written file.
struct ExportedFile {
    std::string name; ///< relative to the folder of the export
    std::uint64_t bytes = 0;
    std::optional<Comparison> error = std::nullopt; ///< of the lightmap in it, where it is measured
    std::optional<SeamError> seams = std::nullopt;  ///< of the same, where it has smooth ones
};

/// ", nRMSE 0.031, bias +0.2 %, seams 0.4 %", to follow the file's size: what of it is known.
std::string errorText(const ExportedFile& file);

/// Exports to `path` and returns the files written, the main file first. Formats hold a lightmap
/// and a grid: fails with the name of any other part of the field.
Result<std::vector<ExportedFile>> exportLight(const std::string& path, const ExportFormat& format,
                                              const ExportScene& scene,
                                              const ExportSettings& settings,
                                              const Progress& progress);

} // namespace limn
