// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/document/clipboard.h"
#include "editor_ui/document/edit_history.h"
#include "editor_ui/document/gesture.h"
#include "editor_ui/document/selection.h"
#include "editor_ui/document/typed_fields.h"
#include "editor_ui/panels/error_history.h"
#include "editor_ui/panels/export_dialog.h"
#include "editor_ui/panels/file_browser.h"
#include "editor_ui/panels/key_map.h"
#include "editor_ui/panels/measured_errors.h"
#include "editor_ui/panels/notice.h"
#include "editor_ui/panels/outliner_panel.h"
#include "editor_ui/panels/palette.h"
#include "editor_ui/panels/recovery_dialog.h"
#include "editor_ui/panels/statistics.h"
#include "editor_ui/panels/workspace.h"
#include "editor_ui/request.h"
#include "editor_ui/view/compare_state.h"
#include "editor_ui/view/explain_state.h"
#include "editor_ui/view/gizmo_drag.h"
#include "editor_ui/view/lint_state.h"
#include "editor_ui/view/overlay_state.h"
#include "editor_ui/view/placement.h"
#include "engine/scene/animation.h"
#include "engine/scene/exposure.h"
#include "engine/scene/scene.h"
#include "engine/scene/view.h"
#include "engine/trace/trace_scene.h"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace limn {

/// What the mouse does to the view camera between press and release.
enum class Navigation { None, Orbit, Pan, Fly };

/// The centre of the window, where the picture is.
struct ViewState {
    View view = View::Lit;
    Inspection inspection = Inspection::None;
    Tonemap tonemap = Tonemap::Aces;
    float exposureEv = 0;      ///< [-kMaxExposureEv, kMaxExposureEv]
    bool autoExposure = false; ///< `exposureEv` follows the picture
    CameraExposure physical;   ///< what `exposureEv` is shown as
    Camera camera;
    glm::vec2 origin{0}, size{1}; ///< [px]
    Tool tool = Tool::Move;
    Navigation navigation = Navigation::None;
    glm::vec3 pivot{0}; ///< about which the view turns while it is Navigation::Orbit
    std::optional<GizmoDrag> drag;
    std::optional<Placeable> placing; ///< what the next click in the picture adds
    glm::vec2 pressedAt{0};
    bool pressed = false; ///< left button went down in the picture and may become a pick
    bool showLights = true;
    GizmoPlace gizmoPlace = GizmoPlace::Middle;
    GizmoSettings gizmo;
    std::optional<PickedSurface> picked; ///< by the last click; see pickedSurface()
    float flySpeed = 2;                  ///< [m/s]
    bool animating = false;              ///< wants another frame although no event came

    Picture picture() const { return {camera, origin, size}; }
};

/// Everything the panels share. Owned by the session; no globals, no back pointers.
struct EditorState {
    Document document;
    std::shared_ptr<const Assets> assets; ///< never null
    std::vector<Bounds> meshBounds;       ///< object space, as Assets::meshes
    std::string projectPath;              ///< empty: never saved
    bool sample = false;                  ///< the scene came with the program
    std::vector<std::string> recent;      ///< newest first
    std::vector<std::string> samples;     ///< names of scenes that come with the program
    EditHistory history;
    ObjectsById saved;               ///< the objects as they are in the file
    std::vector<ObjectId> selection; ///< last element is the active object
    Clipboard clipboard;             ///< outlives the document
    TypedLight typedLight;
    std::vector<ObjectId> isolated; ///< nodes that toggleIsolated() hid
    std::optional<Gesture> gesture; ///< edit in progress: in the document, not yet in history

    ViewState view;
    OverlayState overlay;
    CompareState compare;
    std::set<ObjectId> solo; ///< lights and the sky that alone are shown; empty: all. See solo.h
    ExplainState explain;
    LintState lint;
    LayoutState layout; ///< of the current workspace
    Workspace workspace = Workspace::Light;
    WorkspaceStates workspaces = defaultWorkspaces(); ///< those of the others; see workspacesOf()
    std::set<std::string> closedCards;                ///< titles of the inspector's closed cards
    bool lightTheme = false;                          ///< light panels instead of dark ones
    KeyMap keys;                                      ///< the user's own
    OutlinerState outliner;
    EulerEdit euler;
    std::optional<FileBrowser> fileBrowser;
    std::optional<ExportDialog> exportDialog;
    ExportStatus exporting;
    std::optional<Request> confirm;   ///< waits for "save changes?"
    std::optional<Request> afterSave; ///< goes on once the document is saved
    std::optional<RecoveryOffer> recovery;
    std::optional<Notice> notice; ///< the newest one that was not dismissed
    Palette palette;
    bool autoBake = true; ///< bakes whenever that is needed and nothing is held
    BakeGoals goals;
    double seconds = 0;                              ///< since the start of what is animated
    std::shared_ptr<const SceneAnimation> animation; ///< of the scene file; null: it has none
    bool playing = false;                            ///< `seconds` advances
    Prediction prediction;                           ///< of a bake of the document
    std::shared_ptr<const TraceScene> trace;         ///< for picking; may be a little old or null
    Bounds sceneBounds;
    bool unlit = false; ///< nothing lights the scene
    BakeStatus bake;
    LightingStatus relight;
    RelightPlace relightPlace;
    FrameStatus frame;
    ErrorHistory errors;
    std::string loading; ///< what is being opened; empty: nothing
    std::vector<LogLine> log;
    std::vector<Request> requests; ///< taken by the session each frame
};

/// The active object's id, or 0.
inline ObjectId activeId(const EditorState& state) {
    return state.selection.empty() ? 0 : state.selection.back();
}

/// The object, or null.
inline Object* findObject(EditorState& state, ObjectId id) {
    const auto it = state.document.objects.find(id);
    return it == state.document.objects.end() ? nullptr : &it->second;
}

/// True if the document differs from its file.
inline bool hasUnsavedChanges(const EditorState& state) {
    return state.document.objects != state.saved;
}

/// Path of the project; of the scene where it was never saved as one; empty where there is neither.
inline const std::string& documentPath(const EditorState& state) {
    return state.projectPath.empty() ? state.document.scenePath : state.projectPath;
}

} // namespace limn
