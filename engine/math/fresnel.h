// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

namespace limn {

/// Share of light that a surface reflects whose reflectance at normal incidence is F0. `cosine` in
/// [0, 1] is that of the angle of incidence.
/// Schlick. An Inexpensive BRDF Model for Physically-based Rendering. 1994
inline glm::vec3 schlickFresnel(glm::vec3 F0, float cosine) {
    const float away = 1 - cosine;
    return F0 + (1.f - F0) * (away * away * away * away * away);
}

} // namespace limn
