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

/// The value of R for coefficients `c` of light above the plane with unit normal `n`. T: float for
/// one colour, glm::vec3 for three.
template <class T>
T horizonRadiance(glm::vec3 n, const T* c) {
    return c[0] * kHorizonC0 + (c[3] * n.x + c[1] * n.y + c[2] * n.z) * kHorizonC1;
}

/// Adds the radiance `r` below the plane to `c`, which has at least 4 coefficients.
template <class T>
void addBelow(glm::vec3 n, T r, T* c) {
    c[0] += r * kBelowC0;
    r *= kBelowC1;
    c[1] -= r * n.y;
    c[2] -= r * n.z;
    c[3] -= r * n.x;
}

/// Lets light continue below the plane with unit normal `n`.
template <class T>
void continueBelow(glm::vec3 n, T* c) {
    addBelow(n, horizonRadiance(n, c), c);
}

/// Reverse of continueBelow(): cuts light off at the plane with unit normal `n`.
template <class T>
void cutBelow(glm::vec3 n, T* c) {
    addBelow(n, horizonRadiance(n, c) * (-1 / kHorizonGain), c);
}

/// Weight of R in sums of coefficients times `w`.
template <class T>
T weightOfBelow(glm::vec3 n, const T* w) {
    return w[0] * kBelowC0 - (w[3] * n.x + w[1] * n.y + w[2] * n.z) * kBelowC1;
}

/// Adds weight `s` of R to the weights of the coefficients from which it is computed.
template <class T>
void addHorizonWeight(glm::vec3 n, T s, T* w) {
    w[0] += s * kHorizonC0;
    s *= kHorizonC1;
    w[1] += s * n.y;
    w[2] += s * n.z;
    w[3] += s * n.x;
}

/// Changes weights of coefficients that continueBelow() has changed into those of the coefficients
/// before, of which the sum is the same.
template <class T>
void weighContinued(glm::vec3 n, T* w) {
    addHorizonWeight(n, weightOfBelow(n, w), w);
}

/// The same for cutBelow().
template <class T>
void weighCut(glm::vec3 n, T* w) {
    addHorizonWeight(n, weightOfBelow(n, w) * (-1 / kHorizonGain), w);
}

} // namespace limn
