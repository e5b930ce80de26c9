// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn::render {

/// Bound of how far a pixel's position lies from its surface, in m per m of depth: rasterisers move
/// vertices to the nearest of 2^subPixelBits steps of a pixel in x and y, and with them depth and
/// all that is interpolated (Khronos Group. Vulkan 1.3 Specification, subPixelPrecisionBits. 2022).
/// So what a pixel reads belongs to a point of the surface up to half a step beside it. `rayRight`
/// and `rayUp` lead from the picture's middle to its edges, 1 m deep; `pixelSize` is one over the
/// picture's size in pixels. Rounding of numbers comes on top.
inline float positionError(glm::vec3 rayRight, glm::vec3 rayUp, glm::vec2 pixelSize,
                           std::uint32_t subPixelBits) {
    const glm::vec2 pixel = 2.f * pixelSize * glm::vec2(glm::length(rayRight), glm::length(rayUp));
    return 0.5f * glm::length(pixel) / float(1u << subPixelBits);
}

} // namespace limn::render
