// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/document.h"

#include <glm/vec2.hpp>

namespace limn {

struct EditorState;

/// Where a click at `pixel` wants a new shape, to world space: it stands on the surface there, with
/// its axis along the normal; without a surface, it stands upright at the depth of pivotUnder().
/// Its size is a sixth of the distance from the eye, with two digits.
Transform shapeAtPixel(const EditorState& state, glm::vec2 pixel);

/// The same at the middle of the picture.
Transform shapeBeforeCamera(const EditorState& state);

} // namespace limn
