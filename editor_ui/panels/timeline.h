// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// Seconds after which what is animated in the document begins again: the file's animation, else
/// the longest of the animated textures; 0 where nothing is animated.
double animationLength(const EditorState& state);

/// Lets the time pass that lies between two frames [s], and begins again at the end.
void advanceTime(EditorState& state, double seconds);

/// The row below the picture: play, back to the start, and a slider for the time.
void timeline(EditorState& state);

} // namespace limn
