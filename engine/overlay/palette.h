// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace limn {

/// sRGB-encoded colour [0, 1] as bytes R, G, B, A from the lowest; A = 255.
std::uint32_t packColor(glm::vec3 srgb);

/// Linear Rec. 709 [0, 1] to sRGB-encoded.
glm::vec3 encodeSrgb(glm::vec3 linear);

/// The ramp from dark violet over green to yellow that keeps its order for the colour-blind and in
/// grey; `t` clamped to [0, 1]; sRGB-encoded. S. van der Walt, N. Smith. viridis. 2015, by nine of
/// its values.
glm::vec3 viridis(float t);

/// A colour for number `i`, unlike those of the numbers around it; sRGB-encoded.
glm::vec3 distinctColor(std::uint32_t i);

} // namespace limn
