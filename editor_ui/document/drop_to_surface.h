// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// Puts each selected object onto what lies below its middle, except other selected objects: the
/// lowest point of its bounding box touches that surface, a light or camera stays above it by 1 %
/// of the scene's radius. What has no surface below it stays where it is. One undo step; records
/// nothing where nothing moves or there is no scene to trace yet.
void dropSelection(EditorState& state);

} // namespace limn
