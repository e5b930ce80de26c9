// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/sampling.h"
#include "engine/overlay/overlay_data.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Colour of what is below zero, which no light can be: magenta, which hardly any light is.
inline constexpr glm::vec3 kNegativeLight(1, 0, 0.8f);

/// sRGB-encoded colour of an amount of light, RGB >= 0 in any unit: never white, of half the full
/// brightness where the luminance is `middle` > 0.
glm::vec3 lightColor(glm::vec3 light, float middle);

/// The legend of lightColor(): grey of 0 to 10 times `middle`, with its value in `unit`.
std::vector<OverlayLegend::Entry> lightColorEntries(float middle, const char* unit);

/// sRGB-encoded hue of light, as bright as can be; kNegativeLight where its luminance is below
/// zero.
glm::vec3 lightHue(glm::vec3 light);

/// A function of direction drawn as dots: in each direction one at a distance in proportion to the
/// function's magnitude.
struct LobeShape {
    glm::vec3 position{0};
    float reach = 0; ///< distance of the farthest dot [m]
};

/// Adds the dots of a lobe; none where all magnitudes are 0. `value` and `color` (sRGB-encoded)
/// have one entry per direction. Dots that face down are darker, so that the shape is visible.
void addLobe(const LobeShape& lobe, const DirectionSet& directions, std::span<const float> value,
             std::span<const glm::vec3> color, std::vector<OverlayMark>& marks);

/// Adds a ball whose dot in each direction has a colour of its own, sRGB-encoded.
void addBall(glm::vec3 position, float radius, const DirectionSet& directions,
             std::span<const glm::vec3> color, std::vector<OverlayMark>& marks);

} // namespace limn
