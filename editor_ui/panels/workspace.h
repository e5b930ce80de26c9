// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/view/compare_state.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace limn {

struct EditorState;

/// Tabs of the bottom panel, in their order.
enum class BottomTab : std::uint8_t { Lights, Explain, Check, Profile, Memory, Error, Log };

/// As the file of settings names them.
inline constexpr std::array kBottomTabNames{"lights", "explain", "check", "profile",
                                            "memory", "error",   "log"};

/// Sizes of the fixed panels as the user wants them, at 96 dpi [px]. A small window shows less.
struct LayoutState {
    float left = 270, right = 350, bottom = 212;
    bool bottomOpen = false; ///< else its tabs alone are shown
    BottomTab tab = BottomTab::Lights;

    bool operator==(const LayoutState&) const = default;
};

/// Named arrangements of the window for what one does in it.
enum class Workspace : std::uint8_t { Light, Bake, Inspect, Compare };

/// As the file of settings names them.
inline constexpr std::array kWorkspaceNames{"light", "bake", "inspect", "compare"};

/// What a workspace remembers.
struct WorkspaceState {
    LayoutState layout;
    std::string overlay; ///< OverlayKind::name; empty: none
    Compare compare = Compare::Off;

    bool operator==(const WorkspaceState&) const = default;
};

/// The state of each Workspace.
using WorkspaceStates = std::array<WorkspaceState, kWorkspaceNames.size()>;

/// As they are before the user changes them.
WorkspaceStates defaultWorkspaces();

/// All states, that of the current workspace as the window now has it.
WorkspaceStates workspacesOf(const EditorState& state);

/// Shows a workspace as it is in `states`, an overlay that no technique has as none, and keeps the
/// others for later.
void useWorkspaces(EditorState& state, Workspace current, WorkspaceStates states);

/// Goes to another workspace; the current one is remembered.
void switchWorkspace(EditorState& state, Workspace to);

/// Gives the current workspace its default panel sizes, overlay and comparison.
void resetWorkspace(EditorState& state);

} // namespace limn
