// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <span>

namespace limn {

/// The density of texels of objects that a bake of a selection leaves out, relative to their own.
inline constexpr float kUnselectedDensity = 0.25f;

/// `scene` as a bake of a selection reads it: the instances of `nodes` keep their texels, all
/// others have kUnselectedDensity times their density, and a sixteenth of the texels. So that the
/// former keep theirs, the number of texels asked for is reduced by what the latter lose.
/// O(triangles).
Scene selectionScene(Scene scene, std::span<const ObjectId> nodes);

} // namespace limn
