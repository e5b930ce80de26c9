// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/document.h"

#include <string_view>

namespace limn {

/// Parses `sun dir=x,y,z lux=E`, `point pos=x,y,z cd=I`, `spot pos= dir= cd= inner=DEG outer=DEG`
/// or `rect pos= dir= size=w,h nits=L roll=DEG`, each with optional `color=r,g,b` or `kelvin=T` and
/// `name=`. Strengths may be in any of unitsOf() the kind: `lm=` of point, spot and rect, `ev=` of
/// sun and rect, `cd=` of rect. `ies=FILE` gives point and spot the profile and the intensity of a
/// photometric file, which it reads; `dir=` and `roll=` turn it. On failure the message names the
/// word that was not understood. `pos` is in the file's coordinates, where `origin` is the origin
/// of world space.
Result<Light> parseLight(std::string_view spec, const glm::dvec3& origin = glm::dvec3(0));

/// Parses `r,g,b` [nits] as a sky of one colour.
Result<Sky> parseSky(std::string_view spec);

} // namespace limn
