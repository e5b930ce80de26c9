// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// A high-quality hash of 32 bits (Wellons. Prospecting for Hash Functions. 2018).
inline std::uint32_t mixBits(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352dU;
    x ^= x >> 15;
    x *= 0x846ca68bU;
    x ^= x >> 16;
    return x;
}

/// Converts the upper 24 bits to a number in [0, 1).
inline float unitFloat(std::uint32_t bits) {
    return float(bits >> 8) * 0x1p-24f;
}

/// Radical inverse of i in `base`, in [0, 1): a coordinate of a Halton point.
inline float radicalInverse(std::uint32_t i, std::uint32_t base) {
    double result = 0, digit = 1.0 / base;
    for (; i > 0; i /= base, digit /= base)
        result += digit * (i % base);
    return float(result);
}

/// Orthonormal basis with columns (tangent, bitangent, n); continuous except at n = -z.
/// Duff et al. Building an Orthonormal Basis, Revisited. 2017
inline glm::mat3 basisAround(glm::vec3 n) {
    const float sign = std::copysign(1.f, n.z);
    const float a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

/// A set of `count` well-spread directions: the Fibonacci lattice about z, rotated by a hash of
/// `seed`. Covers the sphere if `sphere`, else the hemisphere z > 0. Each direction stands for a
/// stratum of heights and lies in its middle, so the sums of solid angles, and of solid angles
/// times z, have no error. Of a hemisphere's directions, the share `even` has the same density
/// everywhere, and the others a density in proportion to z.
struct DirectionSet {
    std::uint32_t count;
    bool sphere;
    float turn;
    float even; ///< in (0, 1]; 1 for a sphere

    DirectionSet(std::uint32_t n, bool wholeSphere, std::uint32_t seed, float evenShare = 1)
        : count(n), sphere(wholeSphere), turn(unitFloat(mixBits(seed))),
          even(wholeSphere ? 1 : evenShare) {}

    /// Upper bound of direction i's stratum of heights: the share i / count lies above it.
    float bound(std::uint32_t i) const {
        const float below = float(count - i) / float(count); // share
        if (sphere)
            return 2 * below - 1;
        return 2 * below / (even + std::sqrt(even * even + 4 * (1 - even) * below));
    }
    /// Share of the directions above height z, which may lie below the hemisphere. Inverts bound().
    float above(float z) const {
        if (sphere)
            return (1 - z) / 2;
        z = std::fmax(z, 0.f);
        return (1 - z) * (even + (1 - even) * (1 + z));
    }
    /// Solid angle of the whole set [sr].
    float wholeAngle() const { return (sphere ? 4 : 2) * std::numbers::pi_v<float>; }
    /// Number of directions per solid angle at height z [1/sr].
    float density(float z) const {
        return float(count) / wholeAngle() * (even + 2 * (1 - even) * z);
    }
    /// z of direction i.
    float height(std::uint32_t i) const { return (bound(i) + bound(i + 1)) / 2; }
    /// Solid angle of direction i's stratum [sr]. It follows from the density in its middle, since
    /// the mean slope of a quadratic, such as above(), is that in the middle.
    float solidAngle(std::uint32_t i) const { return 1 / density(height(i)); }
    glm::vec3 operator[](std::uint32_t i) const {
        const double golden = std::numbers::phi - 1;
        const float z = height(i);
        double whole;
        const float angle = 2 * std::numbers::pi_v<float> *
                            float(std::modf(double(i) * golden + double(turn), &whole));
        const float r = std::sqrt(std::fmax(0.f, 1 - z * z));
        return {r * std::cos(angle), r * std::sin(angle), z};
    }
};

/// Maps (x, y) in [0, 1)^2 to a point uniform in the area of a triangle: barycentrics (u, v),
/// weights (1-u-v, u, v). The square is folded along its diagonal, which preserves low discrepancy.
inline glm::vec2 sampleTriangle(glm::vec2 s) {
    if (s.x + s.y > 1)
        s = glm::vec2(1) - s;
    return s;
}

} // namespace limn
