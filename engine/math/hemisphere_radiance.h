// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

namespace limn {

/// Writes bands^2 weights w so that sum w_i c_i estimates the radiance that arrives from unit
/// direction `d` above a surface with unit normal `n`, where c_i are harmonics (sh.h) of light that
/// arrives from above that surface only. The harmonics' own sum fits the whole sphere and is off by
/// up to a half even for constant light; this fits the hemisphere. It is exact for radiance of the
/// form a + b.d; the third band adds its part of what that leaves. Not clamped. Bands in [2, 3].
/// shaders/viewport/near.frag computes the same.
void hemisphereRadianceWeights(int bands, glm::vec3 n, glm::vec3 d, float* w);

} // namespace limn
