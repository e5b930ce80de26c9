// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

namespace limn {

/// A linear Rec. 709 colour as a screen shows it: sRGB-encoded, divided by its largest component
/// where that is above 1.
glm::vec3 displayedColor(glm::vec3 linear);

/// The linear colour that displayedColor() shows as `displayed`, as bright above 1 as `linear` is.
glm::vec3 linearOfDisplayed(glm::vec3 displayed, glm::vec3 linear);

/// The row's widget for a linear colour: its three components as linear numbers, and a swatch that
/// opens a picker. Swatch, picker and hexadecimal code are sRGB, as in other programs. Returns true
/// if the colour was edited.
bool colorField(const char* id, glm::vec3& linear);

} // namespace limn
