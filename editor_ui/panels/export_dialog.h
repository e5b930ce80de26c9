// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"
#include "engine/scene/export_settings.h"

#include <optional>
#include <string>

namespace limn {

struct EditorState;

/// State of an export and of what can be exported, as shown in the dialog.
struct ExportStatus {
    bool running = false;
    std::string stage;
    float fraction = 0;      ///< of the stage [0, 1]
    std::string written;     ///< what the last export wrote; empty: none
    std::string error;       ///< why the last export failed; empty: it did not
    std::string refusal;     ///< why nothing can be exported now; empty: it can
    ExportForecast forecast; ///< of the settings in the dialog
};

/// What the user has chosen so far. Settings become the document's when the export starts.
struct ExportDialog {
    ExportSettings settings;
    std::string path;       ///< file or folder
    bool ownPath = false;   ///< the user chose it; otherwise it follows the format
    bool overwrite = false; ///< the user was warned that it exists
    std::string problem;    ///< with the path; empty: none
};

/// Opens the dialog with the document's settings.
void openExportDialog(EditorState& state);

/// Sets the path, as chosen in the file browser.
void setExportPath(ExportDialog& dialog, std::string path);

/// Draws the dialog while it is open and no file browser is; puts a Request when the user starts or
/// cancels an export.
void exportDialog(EditorState& state);

} // namespace limn
