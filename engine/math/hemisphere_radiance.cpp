// SPDX-License-Identifier: MIT
#include "engine/math/hemisphere_radiance.h"

#include "engine/math/sh.h"

#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

// Let M0 be the integral of radiance over the hemisphere about n and M1 that of radiance times
// direction. For radiance a + b.d, with z = d.n and b = bz n + bt,
//   M0 = 2 pi a + pi bz,   M1.n = pi a + 2 pi/3 bz,   M1 - (M1.n) n = 2 pi/3 bt,
// so a = (2 M0 - 3 M1.n) / pi and bz = (6 M1.n - 3 M0) / pi. The third band of such radiance is
// (15/32) (bz (z^2 - 1/3) + 2 z bt.d); what the third band of `c` has beyond it is added.
void hemisphereRadianceWeights(int bands, glm::vec3 n, glm::vec3 d, float* w) {
    assert(bands == 2 || bands == 3);
    constexpr float pi = glm::pi<float>();
    shBasis(bands, d, w);
    const float z = glm::dot(d, n);
    const glm::vec3 tangent = 3 / (2 * pi) * (d - z * n); // bt.d = dot(tangent, M1)
    float onM0 = (2 - 3 * z) / pi;
    glm::vec3 onM1 = (6 * z - 3) / pi * n + tangent;
    if (bands == 3) {
        const float zonal = z * z - 1.f / 3;
        onM0 += 15.f / 32 * 3 / pi * zonal;
        onM1 -= 15.f / 32 * (6 / pi * zonal * n + 2 * z * tangent);
    }
    const float k1 = std::sqrt(4 * pi / 3); // M1 = k1 (c3, c1, c2)
    w[0] = 2 * std::sqrt(pi) * onM0;        // M0 = 2 sqrt(pi) c0
    w[1] = k1 * onM1.y;
    w[2] = k1 * onM1.z;
    w[3] = k1 * onM1.x;
}

} // namespace limn
