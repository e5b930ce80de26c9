// SPDX-License-Identifier: MIT
#include "engine/export/gltf_quantization.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace limn {

namespace {

constexpr float kUnit = 65535, kSigned = 127;

template <class Integers, class Floats>
std::optional<std::vector<Integers>> unitIntegers(std::span<const Floats> values) {
    std::vector<Integers> integers;
    integers.reserve(values.size());
    for (const Floats& v : values) {
        if (v != glm::clamp(v, Floats(0), Floats(1)))
            return std::nullopt;
        integers.emplace_back(glm::round(v * kUnit));
    }
    return integers;
}

} // namespace

QuantizedCube quantizedCube(const Bounds& bounds) {
    const glm::vec3 size = bounds.size();
    const float edge = std::max({size.x, size.y, size.z});
    return {bounds.lower, edge > 0 ? edge : 1};
}

glm::mat4 fromQuantized(const QuantizedCube& cube) {
    return glm::scale(glm::translate(glm::mat4(1), cube.lower), glm::vec3(cube.edge));
}

std::vector<glm::u16vec4> quantizedPositions(std::span<const glm::vec3> positions,
                                             const QuantizedCube& cube) {
    std::vector<glm::u16vec4> integers;
    integers.reserve(positions.size());
    for (const glm::vec3& p : positions) {
        const glm::vec3 share = glm::clamp((p - cube.lower) / cube.edge, 0.f, 1.f);
        integers.emplace_back(glm::vec4(glm::round(share * kUnit), 0));
    }
    return integers;
}

std::vector<glm::i8vec4> quantizedDirections(std::span<const glm::vec3> directions) {
    std::vector<glm::i8vec4> integers;
    integers.reserve(directions.size());
    for (const glm::vec3& d : directions)
        integers.emplace_back(glm::vec4(glm::round(glm::clamp(d, -1.f, 1.f) * kSigned), 0));
    return integers;
}

std::vector<glm::i8vec4> quantizedTangents(std::span<const glm::vec4> tangents) {
    std::vector<glm::i8vec4> integers;
    integers.reserve(tangents.size());
    for (const glm::vec4& t : tangents)
        integers.emplace_back(glm::round(glm::clamp(t, -1.f, 1.f) * kSigned));
    return integers;
}

std::optional<std::vector<glm::u16vec2>> quantizedUnit(std::span<const glm::vec2> values) {
    return unitIntegers<glm::u16vec2>(values);
}

std::optional<std::vector<glm::u16vec4>> quantizedUnit(std::span<const glm::vec4> values) {
    return unitIntegers<glm::u16vec4>(values);
}

} // namespace limn
