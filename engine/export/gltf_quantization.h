// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/bounds.h"

#include <optional>
#include <span>
#include <vector>

#include <glm/gtc/type_precision.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

// Vertices as integers, as the glTF extension KHR_mesh_quantization allows them. The fourth
// component of what has three is 0 and only keeps vertices aligned to 4 bytes.

/// The cube that quantised positions lie in. Its edges are equal, so that normals keep their
/// directions.
struct QuantizedCube {
    glm::vec3 lower{0};
    float edge = 1; ///< above 0
};
QuantizedCube quantizedCube(const Bounds& bounds);

/// Takes the cube [0, 1]^3 of quantised positions to that cube.
glm::mat4 fromQuantized(const QuantizedCube& cube);

/// Positions within the cube in 65535ths of its edge; the error is half of one.
std::vector<glm::u16vec4> quantizedPositions(std::span<const glm::vec3> positions,
                                             const QuantizedCube& cube);

/// Unit vectors in 127ths.
std::vector<glm::i8vec4> quantizedDirections(std::span<const glm::vec3> directions);

/// Tangents in 127ths; w stays +-1.
std::vector<glm::i8vec4> quantizedTangents(std::span<const glm::vec4> tangents);

/// Values in 65535ths; none where one is outside [0, 1].
std::optional<std::vector<glm::u16vec2>> quantizedUnit(std::span<const glm::vec2> values);
std::optional<std::vector<glm::u16vec4>> quantizedUnit(std::span<const glm::vec4> values);

} // namespace limn
