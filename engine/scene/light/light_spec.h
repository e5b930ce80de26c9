// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/document.h"

#include <string_view>

namespace limn {

/// `sun dir=x,y,z lux=E`, `point pos=x,y,z cd=I`, `spot pos= dir= cd= inner=DEG outer=DEG`,
/// `rect pos= dir= size=w,h nits=L roll=DEG`, each with optional `color=r,g,b` and `name=`. Fails
/// naming the word it did not understand. `pos` is in the file's coordinates, in which `origin` is
/// that of world space.
Result<Light> parseLight(std::string_view spec, const glm::dvec3& origin = glm::dvec3(0));

/// `r,g,b` [nits].
Result<Sky> parseSky(std::string_view spec);

} // namespace limn
