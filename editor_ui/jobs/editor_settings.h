// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/editor_state.h"

#include <set>
#include <string>

namespace limn {

/// What the editor remembers of its window from one start to the next, and from one document to the
/// next.
struct EditorSettings {
    Workspace workspace = Workspace::Light;
    WorkspaceStates workspaces = defaultWorkspaces();
    std::set<std::string> closedCards; ///< of the inspector
    View view = View::Lit;
    Tonemap tonemap = Tonemap::Aces;
    float exposureEv = 0; ///< [-kMaxExposureEv, kMaxExposureEv]
    bool autoExposure = false;
    CameraExposure physical;
    bool showLights = true;
    bool lightTheme = false;
    GizmoSettings gizmo;
    bool autoBake = true;
    KeyMap keys;

    bool operator==(const EditorSettings&) const = default;
};

EditorSettings settingsOf(const EditorState& state);
void useSettings(EditorState& state, const EditorSettings& settings);

/// Converts settings to JSON and back. Whatever is missing, of another type or out of range keeps
/// its default, and unknown fields are ignored, so that any text yields usable settings.
std::string settingsToJson(const EditorSettings& settings);
EditorSettings settingsFromJson(const std::string& json);

/// Reads and writes a file of settings. Defaults where it cannot be read; a failure to write is
/// only logged. The file is replaced atomically.
EditorSettings readEditorSettings(const std::string& path);
void writeEditorSettings(const std::string& path, const EditorSettings& settings);

} // namespace limn
