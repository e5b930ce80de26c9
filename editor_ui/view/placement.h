// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light.h"
#include "engine/scene/mesh/shape_mesh.h"

#include <variant>

#include <glm/vec2.hpp>

namespace limn {

struct EditorState;

/// What a click in the picture can add.
using Placeable = std::variant<LightKind, Shape>;

/// Adds it where a click at `pixel` wants it.
void placeAtPixel(EditorState& state, Placeable what, glm::vec2 pixel);

/// Adds it before the camera.
void placeBeforeCamera(EditorState& state, Placeable what);

} // namespace limn
