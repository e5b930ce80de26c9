// SPDX-License-Identifier: MIT
#include "engine/overlay/palette.h"

#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace limn {

std::uint32_t packColor(glm::vec3 srgb) {
    const glm::uvec3 b(glm::clamp(srgb, 0.f, 1.f) * 255.f + 0.5f);
    return b.x | b.y << 8 | b.z << 16 | 255u << 24;
}

glm::vec3 encodeSrgb(glm::vec3 linear) {
    glm::vec3 c = glm::clamp(linear, 0.f, 1.f);
    for (int k = 0; k < 3; ++k)
        c[k] = c[k] <= 0.0031308f ? 12.92f * c[k] : 1.055f * std::pow(c[k], 1 / 2.4f) - 0.055f;
    return c;
}

glm::vec3 viridis(float t) {
    static constexpr std::array<std::uint32_t, 9> kValues = {
        0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c, 0x28ae80, 0x5ec962, 0xaddc30, 0xfde725};
    const float x = glm::clamp(t, 0.f, 1.f) * 8;
    const auto i = std::size_t(std::fmin(x, 7.f));
    const auto color = [](std::uint32_t v) {
        return glm::vec3(float(v >> 16), float(v >> 8 & 255), float(v & 255)) / 255.f;
    };
    return glm::mix(color(kValues[i]), color(kValues[i + 1]), x - float(i));
}

glm::vec3 distinctColor(std::uint32_t i) {
    // Hues a golden section apart are spread evenly for any number of them; five lightnesses make
    // neighbours differ in grey as well.
    const float turn = float(i % 4096) * 0.618034f;
    const float hue = 6 * (turn - std::floor(turn));
    const glm::vec3 h = glm::clamp(
        glm::abs(glm::mod(glm::vec3(hue) + glm::vec3(0, 4, 2), glm::vec3(6)) - 3.f) - 1.f, 0.f,
        1.f);
    const float value = 0.62f + 0.095f * float(i * 3 % 5), saturation = i & 1 ? 0.85f : 0.55f;
    return value * glm::mix(glm::vec3(1), h, saturation);
}

} // namespace limn
