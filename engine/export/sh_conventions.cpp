// SPDX-License-Identifier: MIT
#include "engine/export/sh_conventions.h"

#include "engine/math/sh.h"
#include "engine/math/sh_basis.h"

#include <cstddef>
#include <numbers>

#include <glm/common.hpp>

namespace limn {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr std::array<std::size_t, 9> kBand = {0, 1, 1, 1, 2, 2, 2, 2, 2};

/// The Condon-Shortley phase (-1)^m.
constexpr std::array<float, 9> kPhase = {1, -1, 1, -1, 1, -1, 1, -1, 1};
/// Signs of the harmonics at (-x, y, z) and (x, y, -z).
constexpr std::array<float, 9> kMirrorX = {1, 1, 1, -1, -1, 1, 1, -1, 1};
constexpr std::array<float, 9> kMirrorZ = {1, 1, -1, 1, 1, -1, 1, -1, 1};

constexpr std::array<float, 9> constants() {
    // The associated Legendre functions have other leading constants than the plain polynomials.
    constexpr auto& k = sh_detail::kNormalisation; // (l, m) at l(l+1)/2 + m
    const float k20 = k[3] / 2, k21 = 3 * k[4], k22 = 3 * k[5];
    return {k[0], k[2], k[1], k[2], 2 * k22, k21, k20, k21, k22};
}

} // namespace

constinit const std::array<float, 9> kShConstants = constants();

Sh3 irradiancePolynomial(const Sh3& c) {
    const auto factors = irradianceFactors();
    Sh3 e;
    for (std::size_t i = 0; i < 9; ++i)
        e[i] = c[i] * (kShConstants[i] * factors[kBand[i]] / kPi);
    return e;
}

Sh3 playcanvasAmbient(const Sh3& c) {
    const Sh3 e = irradiancePolynomial(c);
    return {e[0], e[3], e[1], e[2], e[7], e[5], e[4], e[6], e[8]};
}

Sh3 babylonHarmonics(const Sh3& c, BabylonWorld world) {
    const auto& mirror = world == BabylonWorld::LeftHanded ? kMirrorX : kMirrorZ;
    Sh3 h;
    for (std::size_t i = 0; i < 9; ++i)
        h[i] = c[i] * (kPhase[i] * mirror[i]);
    return h;
}

Sh3 imageBasedLight(const Sh3& c, BabylonWorld world) {
    const auto factors = irradianceFactors();
    Sh3 e = babylonHarmonics(c, world);
    for (std::size_t i = 0; i < 9; ++i)
        e[i] *= factors[kBand[i]];
    return e;
}

Sh3 godotProbe(const Sh3& c) {
    Sh3 p;
    for (std::size_t i = 0; i < 9; ++i)
        p[i] = c[i] / kPi;
    return p;
}

std::array<glm::vec3, 4> godotDirectional(std::span<const glm::vec3, 4> c) {
    std::array<glm::vec3, 4> texel;
    texel[0] = glm::max(c[0] * kShConstants[0], glm::vec3(0));
    for (std::size_t i = 1; i < 4; ++i)
        for (int channel = 0; channel < 3; ++channel) {
            const float l0 = texel[0][channel];
            const float slope = l0 > 0 ? 2.f / 3 * kShConstants[i] * c[i][channel] / (8 * l0) : 0;
            texel[i][channel] = glm::clamp(0.5f + slope, 0.f, 1.f);
        }
    return texel;
}

std::array<glm::vec4, 7> threeGridCell(const Sh3& c) {
    std::array<glm::vec4, 7> cell{};
    for (std::size_t n = 0; n < 27; ++n)
        cell[n / 4][int(n % 4)] = c[n / 3][int(n % 3)];
    return cell;
}

} // namespace limn
