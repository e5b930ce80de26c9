// SPDX-License-Identifier: MIT
#include "editor_ui/panels/action.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/drop_to_surface.h"
#include "editor_ui/document/first_light.h"
#include "editor_ui/document/object_rules.h"
#include "editor_ui/document/selection.h"
#include "editor_ui/document/tree_edit.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/key_map.h"
#include "editor_ui/panels/overlay_panel.h"
#include "editor_ui/panels/timeline.h"
#include "editor_ui/view/camera_control.h"
#include "editor_ui/view/gizmo.h"
#include "editor_ui/view/light_placement.h"
#include "editor_ui/view/pivot.h"
#include "engine/scene/find_object.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace limn {

namespace {

bool always(const EditorState&) {
    return true;
}
bool canUndo(const EditorState& s) {
    return s.history.applied > 0 || s.gesture;
}
bool canRedo(const EditorState& s) {
    return s.history.applied < s.history.edits.size();
}
bool baking(const EditorState& s) {
    return s.bake.running;
}
bool canBake(const EditorState& s) {
    return !s.bake.running && s.loading.empty();
}
bool notLoading(const EditorState& s) {
    return s.loading.empty();
}
bool hasScene(const EditorState& s) {
    return !s.assets->meshes.empty() && s.loading.empty();
}
bool hasSelection(const EditorState& s) {
    return !s.selection.empty();
}

bool hasDeletable(const EditorState& s) {
    return std::ranges::any_of(s.selection, [&](ObjectId id) {
        const auto it = s.document.objects.find(id);
        return it != s.document.objects.end() && canDelete(it->second);
    });
}

bool hasNode(const EditorState& s) {
    return std::ranges::any_of(s.selection,
                               [&](ObjectId id) { return findObjectAs<Node>(s.document, id); });
}

bool canIsolate(const EditorState& s) {
    return hasNode(s) || isIsolated(s);
}

bool isDynamic(const EditorState& s) {
    const Node* node = findObjectAs<Node>(s.document, activeId(s));
    return node && node->dynamic;
}

bool canRename(const EditorState& s) {
    const auto it = s.document.objects.find(activeId(s));
    if (it == s.document.objects.end())
        return false;
    Object copy = it->second;
    return nameOf(copy) != nullptr;
}

const Camera* firstCamera(const EditorState& s) {
    for (const auto& [id, object] : s.document.objects)
        if (const auto* camera = std::get_if<Camera>(&object))
            return camera;
    return nullptr;
}

bool hasCamera(const EditorState& s) {
    return firstCamera(s) != nullptr;
}

void request(EditorState& s, Request::Kind kind, std::string path = {}) {
    s.requests.push_back({kind, std::move(path)});
}

void newFromScene(EditorState& s) {
    openFileBrowser(s, FileBrowser::Purpose::NewFromScene);
}
void open(EditorState& s) {
    openFileBrowser(s, FileBrowser::Purpose::Open);
}
void saveAs(EditorState& s) {
    openFileBrowser(s, FileBrowser::Purpose::SaveAs);
}
void save(EditorState& s) {
    if (s.projectPath.empty())
        saveAs(s);
    else
        request(s, Request::Kind::Save, s.projectPath);
}
void exportLightAction(EditorState& s) {
    openExportDialog(s);
}
void quit(EditorState& s) {
    request(s, Request::Kind::Quit);
}

void undoAction(EditorState& s) {
    undoEdit(s);
}
void redoAction(EditorState& s) {
    redoEdit(s);
}
void selectNone(EditorState& s) {
    s.selection.clear();
    s.outliner.renaming = 0;
}
void selectAll(EditorState& s) {
    s.selection.clear();
    for (const auto& [id, object] : s.document.objects)
        if (canDelete(object))
            s.selection.push_back(id);
}
void startRename(EditorState& s) {
    Object* object = findObject(s, activeId(s));
    s.outliner.renaming = activeId(s);
    s.outliner.newName = *nameOf(*object);
    s.outliner.focusName = true;
}

void putAtRoot(EditorState& s) {
    reparent(s, s.selection, 0);
}

void addSun(EditorState& s) {
    addLight(s, lightBeforeCamera(s, LightKind::Directional));
}
/// Sets a choice of the view, and tells whether it is that.
template <auto member, auto value>
void choose(EditorState& s) {
    s.view.*member = value;
}
template <auto member, auto value>
bool isChosen(const EditorState& s) {
    return s.view.*member == value;
}

template <auto member, auto value>
void chooseGizmo(EditorState& s) {
    s.view.gizmo.*member = value;
}
template <auto member, auto value>
bool isGizmo(const EditorState& s) {
    return s.view.gizmo.*member == value;
}
template <auto member>
void toggleGizmo(EditorState& s) {
    s.view.gizmo.*member = !(s.view.gizmo.*member);
}
template <Tool tool>
void grab(EditorState& s) {
    grabSelection(s, tool);
}

template <auto what>
void place(EditorState& s) {
    s.view.placing = what;
}
template <auto what>
bool places(const EditorState& s) {
    return s.view.placing == Placeable(what);
}
bool placing(const EditorState& s) {
    return s.view.placing.has_value();
}
void placeIt(EditorState& s) {
    placeBeforeCamera(s, *s.view.placing);
    s.view.placing.reset();
}
void addSceneFile(EditorState& s) {
    openFileBrowser(s, FileBrowser::Purpose::AddScene);
}

void focusSelection(EditorState& s) {
    focus(s.view.camera, selectionBounds(s));
}
void sceneCamera(EditorState& s) {
    const auto* active = findObjectAs<Camera>(s.document, activeId(s));
    s.view.camera = active ? *active : *firstCamera(s);
}
template <Side side>
void lookFromSide(EditorState& s) {
    aimAtMiddle(s);
    lookFrom(s.view.camera, side);
}
template <Inspection which>
void toggleInspection(EditorState& s) {
    s.view.inspection = s.view.inspection == which ? Inspection::None : which;
}
template <Compare mode>
void toggleCompare(EditorState& s) {
    s.compare.mode = s.compare.mode == mode ? Compare::Off : mode;
}
template <Compare mode>
bool compares(const EditorState& s) {
    return s.compare.mode == mode;
}
bool canSavePictures(const EditorState& s) {
    return s.compare.reference.error.has_value(); // both pictures exist
}
void savePictures(EditorState& s) {
    openFileBrowser(s, FileBrowser::Purpose::SavePictures);
}
/// "overlay." and the overlay's name, with underscores; null: none.
std::string overlayId(const OverlayKind* kind) {
    std::string id = std::string("overlay.") + (kind ? *kind : kNoOverlay).name;
    std::ranges::replace(id, '-', '_');
    return id;
}
Action makeOverlayAction(const OverlayKind* kind) {
    return {.id = overlayId(kind),
            .label = (kind ? *kind : kNoOverlay).label,
            .menu = Menu::Overlay,
            .enabled = always,
            .run = [kind](EditorState& s) { s.overlay.options.kind = kind; },
            .checked = [kind](const EditorState& s) { return s.overlay.options.kind == kind; }};
}
void toggleLights(EditorState& s) {
    s.view.showLights = !s.view.showLights;
}
void toggleAutoExposure(EditorState& s) {
    s.view.autoExposure = !s.view.autoExposure;
}
bool exposesByItself(const EditorState& s) {
    return s.view.autoExposure;
}
bool lightsShown(const EditorState& s) {
    return s.view.showLights;
}
void explainLight(EditorState& s) {
    s.explain.bringUp = true;
}
void checkScene(EditorState& s) {
    s.layout.bottomOpen = true;
    s.layout.tab = BottomTab::Check;
    s.requests.push_back({Request::Kind::Lint});
}
void toggleTheme(EditorState& s) {
    s.lightTheme = !s.lightTheme;
}
bool hasLightTheme(const EditorState& s) {
    return s.lightTheme;
}
template <Workspace workspace>
void goTo(EditorState& s) {
    switchWorkspace(s, workspace);
}
template <Workspace workspace>
bool isIn(const EditorState& s) {
    return s.workspace == workspace;
}
void toggleBottom(EditorState& s) {
    s.layout.bottomOpen = !s.layout.bottomOpen;
}
bool bottomIsOpen(const EditorState& s) {
    return s.layout.bottomOpen;
}
void screenshot(EditorState& s) {
    request(s, Request::Kind::Screenshot);
}
bool hasOwnKeys(const EditorState& s) {
    return !s.keys.empty();
}
void resetKeys(EditorState& s) {
    s.keys.clear();
}
void askHelp(EditorState& s) {
    s.palette.helpAsked = true;
}
void openPalette(EditorState& s) {
    s.palette.open = true;
}
void startBake(EditorState& s) {
    request(s, Request::Kind::Bake);
}
void bakeToErrorAction(EditorState& s) {
    request(s, Request::Kind::BakeToError);
}
void fitToBudgetAction(EditorState& s) {
    request(s, Request::Kind::FitToBudget);
}
bool canBakeSelection(const EditorState& s) {
    return canBake(s) && hasNode(s);
}
void bakeSelection(EditorState& s) {
    request(s, Request::Kind::BakeSelection);
}
void cancelBake(EditorState& s) {
    request(s, Request::Kind::CancelBake);
}
bool hasAnimation(const EditorState& s) {
    return animationLength(s) > 0;
}
bool plays(const EditorState& s) {
    return s.playing;
}
void togglePlay(EditorState& s) {
    s.playing = !s.playing;
}
void rewindAnimations(EditorState& s) {
    s.seconds = 0;
}
void toggleAutoBake(EditorState& s) {
    s.autoBake = !s.autoBake;
}
bool autoBakes(const EditorState& s) {
    return s.autoBake;
}

constexpr Shortcut kNoKey{};
constexpr Shortcut plain(int k) {
    return {k, kNoMods};
}
constexpr Shortcut ctrl(int k) {
    return {k, kCtrl};
}
constexpr Shortcut shift(int k) {
    return {k, kShift};
}
constexpr Shortcut alt(int k) {
    return {k, kAlt};
}
constexpr Shortcut ctrlShift(int k) {
    return {k, kCtrl | kShift};
}

// clang-format off
std::vector<Action> fixedActions() {
    return {
    {"file.new", "New from scene\u2026", Menu::File, ctrl('N'), kNoKey, false, always, newFromScene},
    {"file.open", "Open\u2026", Menu::File, ctrl('O'), kNoKey, false, always, open},
    {"file.save", "Save", Menu::File, ctrl('S'), kNoKey, true, always, save},
    {"file.save_as", "Save as\u2026", Menu::File, ctrlShift('S'), kNoKey, false, always, saveAs},
    {"file.export", "Export light\u2026", Menu::File, ctrl('E'), kNoKey, true, hasScene, exportLightAction},
    {"file.screenshot", "Screenshot", Menu::File, plain(key::kF12), kNoKey, true, always, screenshot},
    {"file.quit", "Quit", Menu::File, ctrl('Q'), kNoKey, true, always, quit},
    {"edit.undo", "Undo", Menu::Edit, ctrl('Z'), kNoKey, false, canUndo, undoAction},
    {"edit.redo", "Redo", Menu::Edit, ctrlShift('Z'), ctrl('Y'), false, canRedo, redoAction},
    {"edit.duplicate", "Duplicate", Menu::Edit, ctrl('D'), shift('D'), true, hasDeletable, duplicateSelection},
    {"edit.cut", "Cut", Menu::Edit, ctrl('X'), kNoKey, true, hasDeletable, cutSelection},
    {"edit.copy", "Copy", Menu::Edit, ctrl('C'), kNoKey, false, hasDeletable, copySelection},
    {"edit.paste", "Paste", Menu::Edit, ctrl('V'), kNoKey, false, canPaste, pasteClipboard},
    {"edit.rename", "Rename", Menu::Edit, plain(key::kF2), kNoKey, false, canRename, startRename},
    {"edit.delete", "Delete", Menu::Edit, plain(key::kDelete), kNoKey, false, hasDeletable, deleteSelection},
    {"grab.move", "Move with the mouse", Menu::Transform, plain('G'), kNoKey, true, hasDeletable, grab<Tool::Move>},
    {"grab.rotate", "Rotate with the mouse", Menu::Transform, kNoKey, kNoKey, false, hasDeletable, grab<Tool::Rotate>},
    {"grab.scale", "Scale with the mouse", Menu::Transform, plain('S'), kNoKey, false, hasDeletable, grab<Tool::Scale>},
    {"edit.drop", "Drop to the surface below", Menu::Transform, plain(key::kEnd), kNoKey, false, hasDeletable, dropSelection},
    {"edit.hide", "Hide or show", Menu::Visibility, plain('H'), kNoKey, false, hasSelection, toggleHidden},
    {"edit.show_all", "Show all", Menu::Visibility, alt('H'), kNoKey, false, always, showAll},
    {"edit.isolate", "Isolate, or show the others", Menu::Visibility, plain(key::kSlash), kNoKey, false, canIsolate, toggleIsolated, isIsolated},
    {"edit.group", "Group", Menu::Hierarchy, ctrl('G'), kNoKey, false, hasNode, groupSelection},
    {"edit.ungroup", "Ungroup", Menu::Hierarchy, ctrlShift('G'), kNoKey, false, canUngroup, ungroupSelection},
    {"edit.unparent", "Put at the root", Menu::Hierarchy, kNoKey, kNoKey, false, hasNode, putAtRoot},
    {"edit.dynamic", "Static or dynamic", Menu::Edit, kNoKey, kNoKey, false, hasNode, toggleDynamic, isDynamic},
    {"edit.select_all", "Select all", Menu::Edit, ctrl('A'), kNoKey, true, always, selectAll},
    {"edit.select_none", "Select nothing", Menu::Edit, plain(key::kEscape), kNoKey, false, hasSelection, selectNone},
    {"edit.palette", "All actions\u2026", Menu::Edit, ctrl('P'), kNoKey, true, always, openPalette},
    {"add.sun", "Sun", Menu::Add, kNoKey, kNoKey, false, always, addSun},
    {"add.sun_and_sky", "Sun and sky", Menu::Add, kNoKey, kNoKey, false, always, addSunAndSky},
    {"add.point", "Point light", Menu::Add, kNoKey, kNoKey, false, always, place<LightKind::Point>, places<LightKind::Point>},
    {"add.spot", "Spot light", Menu::Add, kNoKey, kNoKey, false, always, place<LightKind::Spot>, places<LightKind::Spot>},
    {"add.rectangle", "Rectangle light", Menu::Add, kNoKey, kNoKey, false, always, place<LightKind::Rectangle>, places<LightKind::Rectangle>},
    {"add.plane", "Plane", Menu::Add, kNoKey, kNoKey, true, always, place<Shape::Plane>, places<Shape::Plane>},
    {"add.box", "Box", Menu::Add, kNoKey, kNoKey, false, always, place<Shape::Box>, places<Shape::Box>},
    {"add.sphere", "Sphere", Menu::Add, kNoKey, kNoKey, false, always, place<Shape::Sphere>, places<Shape::Sphere>},
    {"add.cylinder", "Cylinder", Menu::Add, kNoKey, kNoKey, false, always, place<Shape::Cylinder>, places<Shape::Cylinder>},
    {"add.scene", "Objects of a file\u2026", Menu::Add, kNoKey, kNoKey, false, notLoading, addSceneFile},
    {"add.place", "Place it before the camera", Menu::Add, plain(key::kEnter), plain(key::kPadEnter), true, placing, placeIt},
    {"view.lit", "Lit", Menu::Picture, kNoKey, kNoKey, false, always, choose<&ViewState::view, View::Lit>, isChosen<&ViewState::view, View::Lit>},
    {"view.direct", "Direct only", Menu::Picture, kNoKey, kNoKey, false, always, choose<&ViewState::view, View::Direct>, isChosen<&ViewState::view, View::Direct>},
    {"view.indirect", "Indirect only", Menu::Picture, kNoKey, kNoKey, false, always, choose<&ViewState::view, View::Indirect>, isChosen<&ViewState::view, View::Indirect>},
    {"view.irradiance", "Irradiance", Menu::Picture, kNoKey, kNoKey, false, always, choose<&ViewState::view, View::Irradiance>, isChosen<&ViewState::view, View::Irradiance>},
    {"view.albedo", "Albedo", Menu::Picture, kNoKey, kNoKey, false, always, choose<&ViewState::view, View::Albedo>, isChosen<&ViewState::view, View::Albedo>},
    {"view.normals", "Normals", Menu::Picture, kNoKey, kNoKey, false, always, choose<&ViewState::view, View::Normals>, isChosen<&ViewState::view, View::Normals>},
    {"view.wireframe", "Wireframe", Menu::Picture, kNoKey, kNoKey, true, always, toggleInspection<Inspection::Wireframe>, isChosen<&ViewState::inspection, Inspection::Wireframe>},
    {"view.invalid", "Invalid pixels (NaN, Inf)", Menu::Picture, kNoKey, kNoKey, false, always, toggleInspection<Inspection::InvalidPixels>, isChosen<&ViewState::inspection, Inspection::InvalidPixels>},
    {"view.auto_exposure", "Automatic exposure", Menu::Picture, kNoKey, kNoKey, true, always, toggleAutoExposure, exposesByItself},
    {"compare.reference", "Path-traced reference beside it", Menu::Compare, shift('R'), kNoKey, false, always, toggleCompare<Compare::Reference>, compares<Compare::Reference>},
    {"compare.technique", "Another technique beside it", Menu::Compare, kNoKey, kNoKey, false, always, toggleCompare<Compare::Technique>, compares<Compare::Technique>},
    {"compare.difference", "Difference to the reference", Menu::Compare, kNoKey, kNoKey, true, always, toggleCompare<Compare::Difference>, compares<Compare::Difference>},
    {"compare.flip", "Perceived difference (FLIP) to the reference", Menu::Compare, kNoKey, kNoKey, false, always, toggleCompare<Compare::Flip>, compares<Compare::Flip>},
    {"compare.relmse", "Squared relative error (relMSE)", Menu::Compare, kNoKey, kNoKey, false, always, toggleCompare<Compare::SquaredError>, compares<Compare::SquaredError>},
    {"compare.save", "Save both pictures\u2026", Menu::Compare, kNoKey, kNoKey, true, canSavePictures, savePictures},
    {"view.focus", "Focus selection", Menu::Camera, plain('F'), plain(key::kPadDecimal), true, always, focusSelection},
    {"view.camera", "Scene camera", Menu::Camera, plain(key::kPad0), kNoKey, false, hasCamera, sceneCamera},
    {"view.front", "From the front", Menu::Camera, plain(key::kPad1), kNoKey, true, always, lookFromSide<Side::Front>},
    {"view.back", "From the back", Menu::Camera, ctrl(key::kPad1), kNoKey, false, always, lookFromSide<Side::Back>},
    {"view.right", "From the right", Menu::Camera, plain(key::kPad3), kNoKey, false, always, lookFromSide<Side::Right>},
    {"view.left", "From the left", Menu::Camera, ctrl(key::kPad3), kNoKey, false, always, lookFromSide<Side::Left>},
    {"view.top", "From the top", Menu::Camera, plain(key::kPad7), kNoKey, false, always, lookFromSide<Side::Top>},
    {"view.bottom", "From below", Menu::Camera, ctrl(key::kPad7), kNoKey, false, always, lookFromSide<Side::Bottom>},
    {"tool.select", "Select", Menu::Tool, plain('Q'), kNoKey, false, always, choose<&ViewState::tool, Tool::Select>, isChosen<&ViewState::tool, Tool::Select>},
    {"tool.move", "Move", Menu::Tool, plain('W'), kNoKey, false, always, choose<&ViewState::tool, Tool::Move>, isChosen<&ViewState::tool, Tool::Move>},
    {"tool.rotate", "Rotate", Menu::Tool, plain('E'), kNoKey, false, always, choose<&ViewState::tool, Tool::Rotate>, isChosen<&ViewState::tool, Tool::Rotate>},
    {"tool.scale", "Scale", Menu::Tool, plain('R'), kNoKey, false, always, choose<&ViewState::tool, Tool::Scale>, isChosen<&ViewState::tool, Tool::Scale>},
    {"gizmo.middle", "Gizmo in the middle of the selection", Menu::Gizmo, kNoKey, kNoKey, false, always, choose<&ViewState::gizmoPlace, GizmoPlace::Middle>, isChosen<&ViewState::gizmoPlace, GizmoPlace::Middle>},
    {"gizmo.origins", "Gizmo at the objects' origins", Menu::Gizmo, kNoKey, kNoKey, false, always, choose<&ViewState::gizmoPlace, GizmoPlace::Origins>, isChosen<&ViewState::gizmoPlace, GizmoPlace::Origins>},
    {"gizmo.click", "Gizmo where the object was clicked", Menu::Gizmo, kNoKey, kNoKey, false, always, choose<&ViewState::gizmoPlace, GizmoPlace::Click>, isChosen<&ViewState::gizmoPlace, GizmoPlace::Click>},
    {"gizmo.world", "Axes of the world", Menu::Gizmo, kNoKey, kNoKey, true, always, chooseGizmo<&GizmoSettings::space, GizmoSpace::World>, isGizmo<&GizmoSettings::space, GizmoSpace::World>},
    {"gizmo.local", "Axes of the object", Menu::Gizmo, kNoKey, kNoKey, false, always, chooseGizmo<&GizmoSettings::space, GizmoSpace::Local>, isGizmo<&GizmoSettings::space, GizmoSpace::Local>},
    {"gizmo.view", "Axes of the view", Menu::Gizmo, kNoKey, kNoKey, false, always, chooseGizmo<&GizmoSettings::space, GizmoSpace::View>, isGizmo<&GizmoSettings::space, GizmoSpace::View>},
    {"gizmo.blender_keys", "R rotates at once, as in Blender", Menu::Gizmo, kNoKey, kNoKey, true, always, toggleGizmo<&GizmoSettings::blenderKeys>, isGizmo<&GizmoSettings::blenderKeys, true>},
    {"gizmo.snap", "Snap without Ctrl", Menu::Gizmo, kNoKey, kNoKey, true, always, toggleGizmo<&GizmoSettings::snap>, isGizmo<&GizmoSettings::snap, true>},
    {"workspace.light", "Light workspace", Menu::Workspace, kNoKey, kNoKey, false, always, goTo<Workspace::Light>, isIn<Workspace::Light>},
    {"workspace.bake", "Bake workspace", Menu::Workspace, kNoKey, kNoKey, false, always, goTo<Workspace::Bake>, isIn<Workspace::Bake>},
    {"workspace.inspect", "Inspect workspace", Menu::Workspace, kNoKey, kNoKey, false, always, goTo<Workspace::Inspect>, isIn<Workspace::Inspect>},
    {"workspace.compare", "Compare workspace", Menu::Workspace, kNoKey, kNoKey, false, always, goTo<Workspace::Compare>, isIn<Workspace::Compare>},
    {"workspace.reset", "Reset this workspace", Menu::Workspace, kNoKey, kNoKey, true, always, resetWorkspace},
    {"view.lights", "Light icons", Menu::View, kNoKey, kNoKey, true, always, toggleLights, lightsShown},
    {"view.explain", "Explain the light of a pixel", Menu::View, kNoKey, kNoKey, false, always, explainLight},
    {"view.play", "Play animations", Menu::View, plain(key::kSpace), kNoKey, true, hasAnimation, togglePlay, plays},
    {"view.rewind", "Rewind animations", Menu::View, kNoKey, kNoKey, false, hasAnimation, rewindAnimations},
    {"view.bottom_panel", "Bottom panel", Menu::View, kNoKey, kNoKey, true, always, toggleBottom, bottomIsOpen},
    {"view.light_theme", "Light theme", Menu::View, kNoKey, kNoKey, false, always, toggleTheme, hasLightTheme},
    {"bake.start", "Bake now", Menu::Bake, ctrl('B'), kNoKey, false, canBake, startBake},
    {"bake.error", "Bake until the error holds", Menu::Bake, kNoKey, kNoKey, false, canBake, bakeToErrorAction},
    {"bake.budget", "Fit to budget", Menu::Bake, kNoKey, kNoKey, false, canBake, fitToBudgetAction},
    {"bake.selection", "Bake the selection only", Menu::Bake, kNoKey, kNoKey, false, canBakeSelection, bakeSelection},
    {"bake.cancel", "Cancel the bake", Menu::Bake, kNoKey, kNoKey, false, baking, cancelBake},
    {"bake.check", "Check the scene", Menu::Bake, kNoKey, kNoKey, true, always, checkScene},
    {"bake.automatic", "Bake when needed", Menu::Bake, kNoKey, kNoKey, true, always, toggleAutoBake, autoBakes},
    {"help.keys", "Keys and mouse", Menu::Help, plain(key::kF1), kNoKey, false, always, askHelp},
    {"help.reset_keys", "Reset all keys", Menu::Help, kNoKey, kNoKey, false, hasOwnKeys, resetKeys},
    };
}
// clang-format on

/// Every action; those of overlays come before those of comparisons.
std::vector<Action> makeActions() {
    std::vector<Action> all = fixedActions(), overlays = {makeOverlayAction(nullptr)};
    for (const OverlayKind* kind : overlayKinds())
        overlays.push_back(makeOverlayAction(kind));
    const auto compare = std::ranges::find(all, Menu::Compare, &Action::menu);
    all.insert(compare, std::make_move_iterator(overlays.begin()),
               std::make_move_iterator(overlays.end()));
    return all;
}

} // namespace

std::span<const Action> actions() {
    static const std::vector<Action> all = makeActions();
    return all;
}

const Action& actionById(const char* id) {
    const auto found = std::ranges::find(actions(), id, &Action::id);
    assert(found != actions().end());
    return *found;
}

const Action& overlayAction(const OverlayKind* kind) {
    return actionById(overlayId(kind).c_str());
}

void runAction(EditorState& state, const Action& action) {
    commitGesture(state);
    state.view.drag.reset();
    if (action.enabled(state))
        action.run(state);
}

std::string actionLabel(const EditorState& state, const Action& action) {
    const EditHistory& h = state.history;
    if (action.id == "edit.undo" && state.gesture)
        return "Undo " + state.gesture->label;
    if (action.id == "edit.undo" && h.applied > 0)
        return "Undo " + h.edits[h.applied - 1].label;
    if (action.id == "edit.redo" && h.applied < h.edits.size())
        return "Redo " + h.edits[h.applied].label;
    return action.label;
}

Shortcut shortcutOf(const EditorState& state, const Action& action) {
    const std::vector<Shortcut> keys = shortcutsOf(state, action);
    return keys.empty() ? kNoKey : keys.front();
}

bool runShortcut(EditorState& state, const Shortcut& pressed) {
    for (const Action& action : actions()) {
        const std::vector<Shortcut> keys = shortcutsOf(state, action);
        if (std::ranges::find(keys, pressed) != keys.end()) {
            runAction(state, action);
            return true;
        }
    }
    return false;
}

} // namespace limn
