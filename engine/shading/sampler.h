// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Hashes two numbers to 32 well-spread bits.
inline std::uint32_t mixBits(std::uint32_t a, std::uint32_t b) {
    std::uint64_t x = (std::uint64_t(a) << 32 | b) + 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return std::uint32_t((x ^ (x >> 31)) >> 32);
}

/// Dimension of the Sampler for points on lights that illuminate the first surface that a camera
/// ray meets; each later surface of a path uses the next dimension.
inline constexpr std::uint32_t kOnLightDimension = 1u << 16;

/// Owen-scrambled Sobol points, two dimensions at a time, each pair shuffled on its own. Each value
/// is a pure function of (seed, index, dimension), so nothing depends on threads or order.
/// Burley. Practical Hash-based Owen Scrambling. 2020; the hash is Vegdahl's.
struct Sampler {
    std::uint32_t seed = 0;  ///< differs from pixel to pixel
    std::uint32_t index = 0; ///< number of the sample

    /// A point that is uniform in [0, 1)^2.
    glm::vec2 pair(std::uint32_t dimension) const;
};

inline std::uint32_t reverseBits(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
    x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
    return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
}

/// Flips each bit depending on the bits below it only: Owen's scramble of a bit-reversed number.
inline std::uint32_t scrambleReversed(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// Second Sobol dimension, bit-reversed: Pascal's triangle mod 2, as sums over supersets of bits.
inline std::uint32_t sobolReversed(std::uint32_t x) {
    x ^= (x >> 1) & 0x55555555u;
    x ^= (x >> 2) & 0x33333333u;
    x ^= (x >> 4) & 0x0f0f0f0fu;
    x ^= (x >> 8) & 0x00ff00ffu;
    x ^= (x >> 16) & 0x0000ffffu;
    return x;
}

inline glm::vec2 Sampler::pair(std::uint32_t dimension) const {
    const std::uint32_t s = mixBits(seed, dimension);
    const std::uint32_t shuffled = reverseBits(scrambleReversed(reverseBits(index), s));
    const std::uint32_t x = reverseBits(scrambleReversed(shuffled, mixBits(s, 1)));
    const std::uint32_t y = reverseBits(scrambleReversed(sobolReversed(shuffled), mixBits(s, 2)));
    return {float(x >> 8) * 0x1p-24f, float(y >> 8) * 0x1p-24f};
}

/// Direction at the given angle to unit `n`, rotated about it by `turns` of a full turn.
inline glm::vec3 directionAbout(glm::vec3 n, float sine, float cosine, float turns) {
    // Duff et al. Building an Orthonormal Basis, Revisited. 2017
    const float sign = std::copysign(1.f, n.z);
    const float a = -1 / (sign + n.z), b = n.x * n.y * a;
    const glm::vec3 t(1 + sign * n.x * n.x * a, sign * b, -sign * n.x);
    const glm::vec3 s(b, sign + n.y * n.y * a, -n.y);
    const float phi = 6.2831853f * turns;
    return sine * std::cos(phi) * t + sine * std::sin(phi) * s + cosine * n;
}

/// Samples a direction about unit `n` with density cos / pi.
inline glm::vec3 sampleCosineHemisphere(glm::vec3 n, glm::vec2 u) {
    return directionAbout(n, std::sqrt(u.x), std::sqrt(1 - u.x), u.y);
}

} // namespace limn
