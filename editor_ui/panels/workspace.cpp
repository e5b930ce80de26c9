// SPDX-License-Identifier: MIT
#include "editor_ui/panels/workspace.h"

#include "editor_ui/editor_state.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <utility>

namespace limn {

/// The overlay of this name; null if there is none.
static const OverlayKind* overlayNamed(const std::string& name) {
    const auto kinds = overlayKinds();
    const auto found = std::ranges::find(kinds, name, [](const OverlayKind* k) { return k->name; });
    return found == kinds.end() ? nullptr : *found;
}

static WorkspaceState& kept(WorkspaceStates& states, Workspace workspace) {
    return states[std::size_t(workspace)];
}

WorkspaceStates defaultWorkspaces() {
    WorkspaceStates states; // Light keeps the picture large
    WorkspaceState& bake = kept(states, Workspace::Bake);
    bake.layout = {.right = 400, .bottom = 240, .bottomOpen = true, .tab = BottomTab::Memory};
    WorkspaceState& inspect = kept(states, Workspace::Inspect);
    inspect.layout = {.left = 220, .bottom = 260, .bottomOpen = true, .tab = BottomTab::Explain};
    WorkspaceState& compare = kept(states, Workspace::Compare);
    compare.layout = {.left = 200, .right = 300, .bottomOpen = true, .tab = BottomTab::Error};
    compare.compare = Compare::Reference;
    return states;
}

WorkspaceStates workspacesOf(const EditorState& state) {
    WorkspaceStates states = state.workspaces;
    const OverlayKind* overlay = state.overlay.options.kind;
    kept(states, state.workspace) = {state.layout, overlay ? overlay->name : "",
                                     state.compare.mode};
    return states;
}

void useWorkspaces(EditorState& state, Workspace current, WorkspaceStates states) {
    state.workspace = current;
    state.workspaces = std::move(states);
    const WorkspaceState& shown = kept(state.workspaces, current);
    state.layout = shown.layout;
    state.overlay.options.kind = overlayNamed(shown.overlay);
    state.compare.mode = shown.compare;
}

void switchWorkspace(EditorState& state, Workspace to) {
    useWorkspaces(state, to, workspacesOf(state));
}

void resetWorkspace(EditorState& state) {
    WorkspaceStates states = workspacesOf(state);
    kept(states, state.workspace) = defaultWorkspaces()[std::size_t(state.workspace)];
    useWorkspaces(state, state.workspace, std::move(states));
}

} // namespace limn
