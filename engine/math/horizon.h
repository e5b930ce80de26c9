// SPDX-License-Identifier: MIT
#pragma once

#include "shaders/shared/horizon.h"

#include <glm/vec3.hpp>

namespace limn {

// The light that a texel gathers ends at the plane of its own surface. On a curved surface it is
// read with other normals, whose hemispheres reach below that plane: with a normal tilted by an
// angle t, even light would be (1 + cos t) / 2 as bright as it is. Its harmonics therefore continue
// below the plane with an even radiance R, and each lookup cuts them off again at the plane of the
// surface that it lights. Where both planes are the same, nothing changes.
//
// With M0 and M1 the integrals of radiance and of radiance times direction over the hemisphere
// about n, the radiance a + b z, z = d.n, that has them is a = (2 M0 - 3 M1.n) / pi and b = (6 M1.n
// - 3 M0) / pi. R is its value at z = 1/4, between -1/2 and 5/2 of the mean radiance. The mean
// itself, at z = 1/2, is too bright at vaults, and the value at z = 0 would be -2 times the mean
// under a lamp.
//
// M0 = 2 sqrt(pi) c0 and M1 = sqrt(4 pi / 3) (c3, c1, c2), so R = kHorizonC0 c0 + kHorizonC1 n.(c3,
// c1, c2). R below the plane has c0 = kBelowC0 R and (c3, c1, c2) = -kBelowC1 R n; higher even
// bands are 0, and odd ones beyond the second are left out. Irradiance on the plane does not
// change.
inline constexpr auto kHorizonC0 = float(HORIZON_C0);
inline constexpr auto kHorizonC1 = float(HORIZON_C1);
inline constexpr auto kBelowC0 = float(BELOW_C0);
inline constexpr auto kBelowC1 = float(BELOW_C1);
/// Computed from harmonics that continue already, R comes out as that many times itself.
inline constexpr auto kHorizonGain = float(HORIZON_GAIN);

/// A linear function of the first four coefficients that is symmetric about n: first c0 + second
/// n.(c3, c1, c2).
struct AboutNormal {
    float first, second;
};
/// R of light above the plane.
inline constexpr AboutNormal kHorizonOf{kHorizonC0, kHorizonC1};
/// The coefficients of light of radiance 1 below the plane.
inline constexpr AboutNormal kLightBelow{kBelowC0, -kBelowC1};

/// The function's value for coefficients `c`. T: float for one colour, glm::vec3 for three.
template <class T>
T valueAbout(glm::vec3 n, AboutNormal function, const T* c) {
    return c[0] * function.first + (c[3] * n.x + c[1] * n.y + c[2] * n.z) * function.second;
}

/// Adds the function's factors, times `amount`, to the first four of `c`.
template <class T>
void addAbout(glm::vec3 n, AboutNormal function, T amount, T* c) {
    c[0] += amount * function.first;
    amount *= function.second;
    c[1] += amount * n.y;
    c[2] += amount * n.z;
    c[3] += amount * n.x;
}

/// Radiance R with which light of coefficients `c` continues below the plane with unit normal `n`.
template <class T>
T horizonRadiance(glm::vec3 n, const T* c) {
    return valueAbout(n, kHorizonOf, c);
}

/// Lets light continue below the plane with unit normal `n`.
template <class T>
void continueBelow(glm::vec3 n, T* c) {
    addAbout(n, kLightBelow, horizonRadiance(n, c), c);
}

/// Reverse of continueBelow(): cuts light off at the plane with unit normal `n`.
template <class T>
void cutBelow(glm::vec3 n, T* c) {
    addAbout(n, kLightBelow, horizonRadiance(n, c) * (-1 / kHorizonGain), c);
}

/// Transpose of continueBelow(): turns weights of coefficients after it into weights of those
/// before it. The weighted sums are the same.
template <class T>
void weighContinued(glm::vec3 n, T* w) {
    addAbout(n, kHorizonOf, valueAbout(n, kLightBelow, w), w);
}

/// Transpose of cutBelow(), in the same sense.
template <class T>
void weighCut(glm::vec3 n, T* w) {
    addAbout(n, kHorizonOf, valueAbout(n, kLightBelow, w) * (-1 / kHorizonGain), w);
}

} // namespace limn
