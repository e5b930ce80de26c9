// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/editor_settings.h"

#include "editor_ui/panels/action.h"
#include "engine/core/log.h"
#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"
#include "engine/json/json.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>

namespace limn {

static constexpr std::array kSpaceNames{"world", "local", "view"};
static constexpr std::array kCompareNames{"off",  "reference", "difference",
                                          "flip", "relmse",    "technique"}; // of Compare

EditorSettings settingsOf(const EditorState& state) {
    return {.workspace = state.workspace,
            .workspaces = workspacesOf(state),
            .closedCards = state.closedCards,
            .view = state.view.view,
            .tonemap = state.view.tonemap,
            .exposureEv = state.view.exposureEv,
            .autoExposure = state.view.autoExposure,
            .physical = state.view.physical,
            .showLights = state.view.showLights,
            .lightTheme = state.lightTheme,
            .gizmo = state.view.gizmo,
            .autoBake = state.autoBake,
            .keys = state.keys};
}

void useSettings(EditorState& state, const EditorSettings& settings) {
    useWorkspaces(state, settings.workspace, settings.workspaces);
    state.closedCards = settings.closedCards;
    state.view.view = settings.view;
    state.view.tonemap = settings.tonemap;
    state.view.exposureEv = settings.exposureEv;
    state.view.autoExposure = settings.autoExposure;
    state.view.physical = settings.physical;
    state.view.showLights = settings.showLights;
    state.lightTheme = settings.lightTheme;
    state.view.gizmo = settings.gizmo;
    state.autoBake = settings.autoBake;
    state.keys = settings.keys;
}

static Json workspaceJson(const WorkspaceState& w) {
    return {{"left", w.layout.left},
            {"right", w.layout.right},
            {"bottom", w.layout.bottom},
            {"bottomOpen", w.layout.bottomOpen},
            {"tab", kBottomTabNames[std::size_t(w.layout.tab)]},
            {"overlay", w.overlay},
            {"compare", kCompareNames[std::size_t(w.compare)]}};
}

std::string settingsToJson(const EditorSettings& s) {
    Json workspaces;
    for (std::size_t i = 0; i < kWorkspaceNames.size(); ++i)
        workspaces[kWorkspaceNames[i]] = workspaceJson(s.workspaces[i]);
    Json keys = Json::object();
    for (const auto& [id, shortcut] : s.keys)
        keys[id] = shortcutText(shortcut);
    const Json out = {
        {"workspace", kWorkspaceNames[std::size_t(s.workspace)]},
        {"workspaces", workspaces},
        {"closedCards", std::vector<std::string>(s.closedCards.begin(), s.closedCards.end())},
        {"view", kViewNames[std::size_t(s.view)]},
        {"tonemap", kTonemapNames[std::size_t(s.tonemap)]},
        {"exposure", s.exposureEv},
        {"automaticExposure", s.autoExposure},
        {"aperture", s.physical.aperture},
        {"iso", s.physical.iso},
        {"lightIcons", s.showLights},
        {"lightTheme", s.lightTheme},
        {"gizmoAxes", kSpaceNames[std::size_t(s.gizmo.space)]},
        {"snap", s.gizmo.snap},
        {"moveStep", s.gizmo.moveStep},
        {"rotateStep", s.gizmo.rotateStep},
        {"scaleStep", s.gizmo.scaleStep},
        {"blenderKeys", s.gizmo.blenderKeys},
        {"bakeWhenNeeded", s.autoBake},
        {"keys", keys}};
    return out.dump(2) + '\n';
}

static void readNumber(const Json& in, const char* key, float lower, float upper, float& out) {
    const Json& value = in[key];
    if (!value.isNumber())
        return;
    const double number = value.get<double>();
    if (number >= double(lower) && number <= double(upper)) // not of NaN either
        out = float(number);
}

static void readFlag(const Json& in, const char* key, bool& value) {
    if (const Json& flag = in[key]; flag.isBoolean())
        value = flag.get<bool>();
}

static std::string readText(const Json& in, const char* key) {
    const Json& text = in[key];
    return text.isString() ? text.get<std::string>() : std::string();
}

template <class T, class Names>
static void readName(const Json& in, const char* key, const Names& names, T& value) {
    const std::string text = readText(in, key);
    if (const auto found = std::ranges::find(names, text); found != names.end())
        value = T(std::distance(names.begin(), found));
}

static void readWorkspace(const Json& in, WorkspaceState& w) {
    if (!in.isObject())
        return;
    constexpr float kWidest = 10000;
    readNumber(in, "left", 0, kWidest, w.layout.left);
    readNumber(in, "right", 0, kWidest, w.layout.right);
    readNumber(in, "bottom", 0, kWidest, w.layout.bottom);
    readFlag(in, "bottomOpen", w.layout.bottomOpen);
    readName(in, "tab", kBottomTabNames, w.layout.tab);
    w.overlay = readText(in, "overlay");
    readName(in, "compare", kCompareNames, w.compare);
}

/// Reads the user's keys. Unknown actions are ignored; of several actions with the same key, only
/// the first one in the table of actions gets it.
static void readKeys(const Json& in, KeyMap& keys) {
    const Json& given = in["keys"];
    for (const Action& action : actions()) {
        const Json& text = given[action.id];
        if (!text.isString())
            continue;
        const auto shortcut = shortcutFromText(text.get<std::string>());
        const bool none = shortcut == Shortcut{};
        const auto same = [&](const auto& chosen) { return chosen.second == shortcut; };
        if (none || (shortcut && isAssignable(*shortcut) && std::ranges::none_of(keys, same)))
            keys[action.id] = *shortcut;
    }
}

EditorSettings settingsFromJson(const std::string& text) {
    EditorSettings s;
    constexpr int kMaxDepth = 8; // what is deeper was not written by us
    const Json in = parseJson(text, kMaxDepth).value_or(Json());
    readName(in, "workspace", kWorkspaceNames, s.workspace);
    for (std::size_t i = 0; i < kWorkspaceNames.size(); ++i)
        readWorkspace(in["workspaces"][kWorkspaceNames[i]], s.workspaces[i]);
    for (const Json& title : in["closedCards"])
        if (title.isString())
            s.closedCards.insert(title.get<std::string>());
    readNumber(in, "exposure", -kMaxExposureEv, kMaxExposureEv, s.exposureEv);
    readFlag(in, "automaticExposure", s.autoExposure);
    readNumber(in, "aperture", kMinAperture, kMaxAperture, s.physical.aperture);
    readNumber(in, "iso", kMinIso, kMaxIso, s.physical.iso);
    readName(in, "view", kViewNames, s.view);
    readName(in, "tonemap", kTonemapNames, s.tonemap);
    readFlag(in, "lightIcons", s.showLights);
    readFlag(in, "lightTheme", s.lightTheme);
    readName(in, "gizmoAxes", kSpaceNames, s.gizmo.space);
    readFlag(in, "snap", s.gizmo.snap);
    readNumber(in, "moveStep", 0, kMaxMoveStep, s.gizmo.moveStep);
    readNumber(in, "rotateStep", kMinRotateStep, kMaxRotateStep, s.gizmo.rotateStep);
    readNumber(in, "scaleStep", kMinScaleStep, kMaxScaleStep, s.gizmo.scaleStep);
    readFlag(in, "blenderKeys", s.gizmo.blenderKeys);
    readFlag(in, "bakeWhenNeeded", s.autoBake);
    readKeys(in, s.keys);
    return s;
}

EditorSettings readEditorSettings(const std::string& path) {
    return settingsFromJson(readFile(path, 1 << 16).value_or(""));
}

void writeEditorSettings(const std::string& path, const EditorSettings& settings) {
    std::error_code error;
    std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
    if (const Result<void> written = replaceFile(path, settingsToJson(settings)); !written)
        logWarning(written.error().message);
}

} // namespace limn
