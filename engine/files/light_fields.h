// SPDX-License-Identifier: MIT
#pragma once

#include "engine/files/material_fields.h"
#include "engine/scene/light/light.h"

#include <glm/gtc/constants.hpp>

namespace limn {

// Lists the fields of lights; document_fields.h lists those of other objects.

template <class Fields, class T>
void describeProfile(Fields& fields, T& p) {
    fields("name", p.name);
    fields("peak", p.peak, kLightRange);
    fields("firstVertical", p.firstVertical, FieldRange{0, 180});
    fields("lastVertical", p.lastVertical, FieldRange{0, 180});
    fields("rows", p.rows);
    fields("columns", p.columns);
    fields("share", p.share);
}

template <class Fields, class T>
void describeLight(Fields& fields, T& l) {
    fields("name", l.name);
    fields("kind", l.kind, kLightNames);
    fields("enabled", l.enabled);
    fields.place("position", l.position);
    fields("direction", l.direction);
    fields("color", l.color, kLightRange);
    fields("strength", l.strength, kLightRange);
    fields("range", l.range, kNotNegative);
    fields("innerAngle", l.innerAngle, FieldRange{0, glm::half_pi<double>()});
    // The nearest float to pi/2 lies above it.
    fields("outerAngle", l.outerAngle, FieldRange{0, double(glm::half_pi<float>())});
    fields("size", l.size, FieldRange{kMinLightSize, kMaxLightSize});
    fields("roll", l.roll);
    fields.profile("profile", l.profile);
}

} // namespace limn
