// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace limn {

/// Packs an sRGB-encoded colour [0, 1] into bytes R, G, B, A from the lowest; A = 255.
std::uint32_t packColor(glm::vec3 srgb);

/// Converts linear Rec. 709 [0, 1] to sRGB-encoded.
glm::vec3 encodeSrgb(glm::vec3 linear);

/// The viridis colour map, sRGB-encoded: from dark violet through green to yellow, ordered also for
/// colour-blind viewers and in grey. `t` is clamped to [0, 1]. S. van der Walt, N. Smith. viridis.
/// 2015, interpolated from nine of its values.
glm::vec3 viridis(float t);

/// A colour for number `i` that differs from those of nearby numbers; sRGB-encoded.
glm::vec3 distinctColor(std::uint32_t i);

} // namespace limn
