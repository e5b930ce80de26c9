// SPDX-License-Identifier: MIT
#include "engine/scene/specular.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

glm::vec3 specularAlbedo(const Gloss& gloss, float NoV) {
    const float k = 1 - gloss.roughness;
    const float y = 0.0425f - 0.0275f * gloss.roughness, z = 1.04f - 0.572f * gloss.roughness,
                w = 0.022f * gloss.roughness - 0.04f;
    const float a = std::min(k * k, std::exp2(-9.28f * NoV)) * k + y;
    return glm::max(gloss.F0 * (z - 1.04f * a) + (1.04f * a + w), glm::vec3(0));
}

glm::vec3 specularBrdf(const Gloss& gloss, glm::vec3 n, glm::vec3 toEye, glm::vec3 toLight) {
    const glm::vec3 h = glm::normalize(toEye + toLight);
    const float NoL = std::max(glm::dot(n, toLight), 0.f),
                NoV = std::max(glm::dot(n, toEye), 1e-4f);
    const float NoH = std::clamp(glm::dot(n, h), 0.f, 1.f),
                VoH = std::clamp(glm::dot(toEye, h), 0.f, 1.f);
    const float alpha = std::max(gloss.roughness * gloss.roughness, 2e-3f), a2 = alpha * alpha;
    const float k = NoH * NoH * (a2 - 1) + 1;
    const float D = a2 / (std::numbers::pi_v<float> * k * k);
    const float V = 0.5f / glm::mix(2 * NoL * NoV, NoL + NoV, alpha);
    const float away = 1 - VoH;
    return D * V * (gloss.F0 + (1.f - gloss.F0) * (away * away * away * away * away));
}

} // namespace limn
