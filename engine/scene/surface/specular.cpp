// SPDX-License-Identifier: MIT
#include "engine/scene/surface/specular.h"

#include "engine/math/fresnel.h"
#include "engine/math/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kMinAlpha = 2e-3f, kMinNoV = 1e-4f;

float alphaOf(float roughness) {
    return std::max(roughness * roughness, kMinAlpha);
}

/// Hammon's approximation of the height-correlated Smith term over 4 NoL NoV.
float visibility(float alpha, float NoL, float NoV) {
    return 0.5f / glm::mix(2 * NoL * NoV, NoL + NoV, alpha);
}

float ggx(float a2, float NoH) {
    const float k = NoH * NoH * (a2 - 1) + 1;
    return a2 / (std::numbers::pi_v<float> * k * k);
}

/// Twice the cosine over Smith's masking of the eye: 2 NoV / G_1.
float twiceUnmasked(float a2, float NoV) {
    return NoV + std::sqrt(a2 + (1 - a2) * NoV * NoV);
}

/// Direction of the eye in the frame of z; an eye below the horizon is treated as just above it.
glm::vec3 localEye(const glm::mat3& basis, glm::vec3 toEye) {
    glm::vec3 v = toEye * basis;
    v.z = std::max(v.z, kMinNoV);
    return glm::normalize(v);
}

/// Samples a normal about z that is visible from `v`: the half of the disc that faces `v`, in the
/// space where the microfacets form a hemisphere.
glm::vec3 visibleNormal(glm::vec3 v, float alpha, glm::vec2 u) {
    const glm::vec3 stretched = glm::normalize(glm::vec3(alpha * v.x, alpha * v.y, v.z));
    const float across =
        stretched.x * stretched.x + stretched.y * stretched.y; // 0 where seen straight
    const glm::vec3 t1 = across > 0 ? glm::vec3(-stretched.y, stretched.x, 0) / std::sqrt(across)
                                    : glm::vec3(1, 0, 0),
                    t2 = glm::cross(stretched, t1);
    const float r = std::sqrt(u.x), phi = 2 * std::numbers::pi_v<float> * u.y;
    const float x = r * std::cos(phi), s = 0.5f * (1 + stretched.z);
    const float y = (1 - s) * std::sqrt(std::max(1 - x * x, 0.f)) + s * r * std::sin(phi);
    const glm::vec3 n = x * t1 + y * t2 + std::sqrt(std::max(1 - x * x - y * y, 0.f)) * stretched;
    return glm::normalize(glm::vec3(alpha * n.x, alpha * n.y, std::max(n.z, 0.f)));
}

} // namespace

glm::vec3 specularBrdf(const Gloss& gloss, glm::vec3 n, glm::vec3 toEye, glm::vec3 toLight) {
    const glm::vec3 h = glm::normalize(toEye + toLight);
    const float NoL = std::max(glm::dot(n, toLight), 0.f),
                NoV = std::max(glm::dot(n, toEye), kMinNoV);
    const float NoH = std::clamp(glm::dot(n, h), 0.f, 1.f),
                VoH = std::clamp(glm::dot(toEye, h), 0.f, 1.f);
    const float alpha = alphaOf(gloss.roughness);
    return ggx(alpha * alpha, NoH) * visibility(alpha, NoL, NoV) * schlickFresnel(gloss.F0, VoH);
}

/// V NoL / pdf with pdf = G_1 D VoH / NoV / (4 VoH), where the nearly singular D cancels.
static float shareOfFacet(float alpha, float NoV, float NoL) {
    return 2 * NoL * visibility(alpha, NoL, NoV) * twiceUnmasked(alpha * alpha, NoV);
}

glm::vec3 sampleFacet(float roughness, glm::vec3 n, glm::vec3 toEye, glm::vec2 u) {
    const glm::mat3 basis = basisAround(n);
    return basis * visibleNormal(localEye(basis, toEye), alphaOf(roughness), u);
}

float facetShare(float roughness, float NoV, float NoL) {
    return NoL > 0 ? std::min(shareOfFacet(alphaOf(roughness), std::max(NoV, kMinNoV), NoL), 1.f)
                   : 0;
}

SpecularSample sampleSpecular(const Gloss& gloss, glm::vec3 n, glm::vec3 toEye, glm::vec2 u) {
    const float alpha = alphaOf(gloss.roughness);
    const glm::mat3 basis = basisAround(n);
    const glm::vec3 v = localEye(basis, toEye);
    const glm::vec3 h = visibleNormal(v, alpha, u);
    const float VoH = std::clamp(glm::dot(v, h), 0.f, 1.f);
    const glm::vec3 l = 2 * VoH * h - v;
    SpecularSample sample;
    if (!(l.z > 0))
        return sample;
    sample.toLight = basis * glm::normalize(l);
    sample.weight = schlickFresnel(gloss.F0, VoH) * shareOfFacet(alpha, v.z, l.z);
    return sample;
}

float specularPdf(float roughness, glm::vec3 n, glm::vec3 toEye, glm::vec3 toLight) {
    const glm::mat3 basis = basisAround(n);
    const glm::vec3 v = localEye(basis, toEye), l = toLight * basis;
    if (!(l.z > 0))
        return 0;
    const float alpha = alphaOf(roughness), a2 = alpha * alpha;
    return ggx(a2, glm::normalize(v + l).z) / (2 * twiceUnmasked(a2, v.z));
}

} // namespace limn
