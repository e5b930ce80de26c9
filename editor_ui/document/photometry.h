// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light.h"

namespace limn {

/// Luminous flux [lm] of a point or spot light of strength [cd], or a rectangle of [nits]. Point: 4
/// pi I. Spot, with glTF's squared edge: 2 pi I ((1 - cos inner) + (cos inner - cos outer) / 3).
/// Rectangle: pi L A. Directional: 0, it has none.
float lumen(const Light& light);

/// Strength [cd, nits] that gives `flux` [lm]; the light's own strength when it has no flux.
float strengthForLumen(const Light& light, float flux);

/// Linear Rec. 709 colour of a black body, with a largest component of 1 and none below 0.
/// Temperatures are clamped to [1667, 25000] K. Kim, Kang, Hong, Hwang. Design of advanced color
/// temperature control system for HDTV applications. 2002
glm::vec3 blackbodyColor(float kelvin);

/// Temperature [K] whose chromaticity is nearest to `color`; 6500 for black.
float nearestKelvin(glm::vec3 color);

} // namespace limn
