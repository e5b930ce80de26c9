// SPDX-License-Identifier: MIT
#include "engine/scene/surface/reflection_lobe.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

// Argument `samples` of integrateReflection() for each node: enough for errors of 0.005.
constexpr int kSamples = 40;
constexpr glm::vec3 kNormal(0, 0, 1);

struct WeightedDirection {
    glm::dvec3 direction;
    double weight;
};

/// Adds weight P_l of the cosine to all factors.
void addLegendre(double cosine, double weight, std::vector<double>& factors) {
    double before = 0, p = 1;
    for (std::size_t l = 0; l < factors.size(); ++l) {
        factors[l] += weight * p;
        const double next = (double(2 * l + 1) * cosine * p - double(l) * before) / double(l + 1);
        before = p;
        p = next;
    }
}

std::vector<glm::vec4> makeTable() {
    constexpr std::size_t n = kReflectionNodes;
    std::vector<glm::vec4> table(n * n * kReflectionLayers);
    for (std::size_t y = 0; y < n; ++y)
        for (std::size_t x = 0; x < n; ++x) {
            const float root = float(x) / float(n - 1);
            const LobeIntegral lobe =
                integrateReflection(float(y) / float(n - 1), root * root, kSamples, kMaxBands);
            const auto& s = lobe.factors;
            glm::vec4* node = &table[y * n + x];
            node[0] = glm::vec4(lobe.share, lobe.towards);
            node[n * n] = glm::vec4(s[2], s[3], s[4], s[5]);
            node[2 * n * n] = glm::vec4(s[6], s[7], 0, 0);
        }
    return table;
}

} // namespace

LobeIntegral integrateReflection(float roughness, float NoV, int samples, std::size_t bands) {
    // The eye lies in the plane x = 0. The lobe is symmetric about that plane, so half the circle
    // of visible normals is sufficient; the other half mirrors x.
    NoV = std::clamp(NoV, 1e-4f, 1 - 1e-4f);
    const glm::vec3 toEye(0, std::sqrt(1 - NoV * NoV), NoV);
    const Gloss gloss{{1, 0, 0}, roughness}; // all of F0 in x, nothing of it in y
    std::vector<WeightedDirection> all;
    glm::dvec3 mean(0);
    glm::dvec2 sum(0);
    for (int i = 0; i < samples; ++i) {
        // u.x = 1 - rest^k. Where it is near 1, facets lie in the tail of GGX, which matters if the
        // lobe is narrow; for a wide lobe it is below the horizon.
        const float k = 2 - roughness, rest = 1 - (float(i) + 0.5f) / float(samples);
        for (int j = 0; j < samples / 2; ++j) {
            const glm::vec2 u(1 - std::pow(rest, k), (float(j) + 0.5f) / float(samples) - 0.25f);
            SpecularSample s = sampleSpecular(gloss, kNormal, toEye, u);
            if (s.weight.x == 0)
                continue;
            s.weight *= k * std::pow(rest, k - 1);
            all.push_back({s.toLight, s.weight.x});
            mean += glm::dvec3(s.toLight) * double(s.weight.x);
            sum += glm::dvec2(s.weight.x, s.weight.y);
        }
    }
    mean /= sum.x;
    mean.x = 0;
    LobeIntegral lobe;
    lobe.share = glm::dvec2(sum.x - sum.y, sum.y) / (0.5 * samples * samples);
    lobe.towards.y = -mean.y / double(toEye.y);
    lobe.towards.x = mean.z - lobe.towards.y * double(NoV);
    lobe.factors.assign(bands, 0);
    const glm::dvec3 axis = glm::normalize(mean);
    for (const WeightedDirection& d : all)
        addLegendre(glm::dot(d.direction, axis), d.weight / sum.x, lobe.factors);
    return lobe;
}

std::span<const glm::vec4> reflectionTable() {
    static const std::vector<glm::vec4> table = makeTable();
    return table;
}

ReflectionLobe reflectionLobe(float roughness, float NoV) {
    constexpr std::size_t n = kReflectionNodes;
    const std::span<const glm::vec4> table = reflectionTable();
    const auto position =
        glm::clamp(glm::vec2(std::sqrt(std::max(NoV, 0.f)), roughness), 0.f, 1.f) * float(n - 1);
    const glm::vec2 base = glm::min(glm::floor(position), float(n - 2)), f = position - base;
    const std::size_t first = std::size_t(base.y) * n + std::size_t(base.x);
    const auto read = [&](std::size_t layer) {
        const glm::vec4* node = &table[layer * n * n + first];
        return glm::mix(glm::mix(node[0], node[1], f.x), glm::mix(node[n], node[n + 1], f.x), f.y);
    };
    const glm::vec4 a = read(0), b = read(1), c = read(2);
    ReflectionLobe lobe;
    lobe.share = {a.x, a.y};
    lobe.towards = {a.z, a.w};
    const float s1 = std::sqrt(a.z * a.z + a.w * a.w + 2 * a.z * a.w * NoV);
    lobe.factors = {1, s1, b.x, b.y, b.z, b.w, c.x, c.y};
    return lobe;
}

glm::vec3 lobeAxis(const ReflectionLobe& lobe, glm::vec3 n, glm::vec3 mirrored) {
    return glm::normalize(lobe.towards.x * n + lobe.towards.y * mirrored);
}

glm::vec3 specularAlbedo(const Gloss& gloss, float NoV) {
    const ReflectionLobe lobe = reflectionLobe(gloss.roughness, NoV);
    return gloss.F0 * lobe.share.x + lobe.share.y;
}

} // namespace limn
