// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

namespace limn {

struct EditorState;

/// True if the scene has surfaces but no light, no emissive surface that is shown and a black sky.
bool nothingShines(const Scene& scene);

/// Adds a white sun and, where the sky is black, an even grey one, in strengths that show a surface
/// of medium albedo well at exposure 0. One undo step; selects the sun.
void addSunAndSky(EditorState& state);

} // namespace limn
