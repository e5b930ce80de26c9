// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light.h"

#include <glm/vec2.hpp>

namespace limn {

struct EditorState;

/// A new light of `kind`, named after it, where a click at `pixel` wants it: off the surface there,
/// along its normal, so that it lights what lies before the surface. Without a surface it lies at
/// the depth of pivotUnder() and shines down. Its size and strength fit the distances around it and
/// the exposure: 5 W m^-2 (a sun: 10) at the median distance, at 0 EV.
Light lightAtPixel(const EditorState& state, LightKind kind, glm::vec2 pixel);

/// The same in the open air before the camera: on the ray through the middle of the picture, back
/// from what it sees by half the way to the eye, or a quarter of the scene if that is less.
Light lightBeforeCamera(const EditorState& state, LightKind kind);

/// `value` with two digits, as one would have typed it; 0 where it is not positive.
float roundedToTwoDigits(float value);

} // namespace limn
