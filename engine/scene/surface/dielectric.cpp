// SPDX-License-Identifier: MIT
#include "engine/scene/surface/dielectric.h"

#include "engine/scene/surface/specular.h"

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

float iorOfF0(float reflectance) {
    const double root = std::sqrt(std::clamp(double(reflectance), 0.0, 0.99));
    return float((1 + root) / (1 - root));
}

glm::vec3 refractedDirection(glm::vec3 n, glm::vec3 toLight, float eta) {
    const float incident = std::clamp(glm::dot(n, toLight), 0.f, 1.f);
    const float sine2 = refractedSine2(incident, eta);
    if (!(sine2 < 1))
        return glm::vec3(0);
    return glm::normalize((incident / eta - std::sqrt(1 - sine2)) * n - toLight / eta);
}

BoundarySplit splitAtBoundary(const Transmission& t, glm::vec3 n, glm::vec3 toLight, bool inside,
                              glm::vec2 u) {
    const bool isSmooth = t.roughness < kSmoothRoughness;
    const glm::vec3 facet = isSmooth ? n : sampleFacet(t.roughness, n, toLight, u);
    const float cosine = glm::dot(facet, toLight);
    const float eta = inside && !t.isThin ? 1 / t.ior : t.ior;
    BoundarySplit split;
    split.reflectance = fresnelDielectric(cosine, eta);
    split.mirrored = glm::normalize(2 * cosine * facet - toLight);
    if (t.isThin) // without bending: on the other side of the mirrored direction
        split.refracted = split.mirrored - 2 * glm::dot(split.mirrored, n) * n;
    else
        split.refracted = refractedDirection(facet, toLight, eta);
    if (!(glm::dot(split.mirrored, n) > 0))
        split.mirrored = glm::vec3(0);
    if (!(glm::dot(split.refracted, n) < 0))
        split.refracted = glm::vec3(0);
    if (!isSmooth) {
        const float NoL = glm::dot(n, toLight);
        split.mirroredShare = facetShare(t.roughness, NoL, glm::dot(n, split.mirrored));
        split.refractedShare = facetShare(t.roughness, NoL, -glm::dot(n, split.refracted));
    }
    return split;
}

} // namespace limn
