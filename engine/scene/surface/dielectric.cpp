// SPDX-License-Identifier: MIT
#include "engine/scene/surface/dielectric.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

/// Squared sine of the refracted direction's angle. Above 1 under total internal reflection.
static float refractedSine2(float cosine, float eta) {
    const float sine2 = std::max(1 - cosine * cosine, 0.f);
    return sine2 / eta / eta;
}

float fresnelDielectric(float cosine, float eta) {
    const float incident = std::clamp(cosine, 0.f, 1.f);
    const float sine2 = refractedSine2(incident, eta);
    if (!(sine2 < 1))
        return 1;
    const float transmitted = std::sqrt(1 - sine2);
    const float parallel = (eta * incident - transmitted) / (eta * incident + transmitted);
    const float perpendicular = (incident - eta * transmitted) / (incident + eta * transmitted);
    return (parallel * parallel + perpendicular * perpendicular) / 2;
}

float dielectricF0(float ior) {
    const double root = (double(ior) - 1) / (double(ior) + 1);
    return float(root * root);
}

glm::vec3 refractedDirection(glm::vec3 n, glm::vec3 toLight, float eta) {
    const float incident = std::clamp(glm::dot(n, toLight), 0.f, 1.f);
    const float sine2 = refractedSine2(incident, eta);
    if (!(sine2 < 1))
        return glm::vec3(0);
    return glm::normalize((incident / eta - std::sqrt(1 - sine2)) * n - toLight / eta);
}

} // namespace limn
