// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

struct EditorState;

/// Over the foot of a picture that is black because nothing lights the scene: says so, and offers a
/// sun and a sky.
void noLightHint(EditorState& state);

} // namespace limn
