// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light.h"

namespace limn {

/// The light with its name cleared, on, and with a colour and strength of 1: what its shadows and
/// the places that it lights depend on. Light of the original is this one's, times colour and
/// strength.
inline Light unitLight(Light light) {
    light.name.clear();
    light.enabled = true;
    light.color = glm::vec3(1);
    light.strength = 1;
    return light;
}

} // namespace limn
