// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/skin_part.h"

#include "engine/field/sample_field.h"
#include "engine/scene/surface/specular.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kPartPi = std::numbers::pi_v<float>;
constexpr float kTiny = 1e-12f; ///< avoids a division by 0 [m]

/// Weights of the list; factor(c) is that of the directions.
template <class Factor>
SkinWeights weightsOf(const LightCaches& caches, std::span<const std::uint32_t> list,
                      glm::vec3 position, const Factor& factor) {
    std::array<float, NearestCaches::kLength> distance{};
    float farthest = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
        distance[i] = glm::distance(position, caches.position[list[i]]);
        farthest = std::max(farthest, distance[i]);
    }
    if (list.size() < NearestCaches::kLength)
        farthest *= 2;
    SkinWeights weights;
    float sum = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const float near = farthest > 0 ? 1 - distance[i] / farthest : 1;
        const float weight = near * std::sqrt(std::max(factor(list[i]), 0.f));
        if (!(weight > 0))
            continue;
        weights.cache[weights.count] = list[i];
        weights.weight[weights.count++] = weight;
        sum += weight;
    }
    for (std::size_t i = 0; i < weights.count; ++i)
        weights.weight[i] /= sum;
    return weights;
}

/// The way from a point to the mean place of proxies.
struct WayToProxy {
    glm::vec3 direction{0}; ///< unit
    float perFlux = 0;      ///< (4 pi r^2)^-1
};
template <class ProxyOf>
WayToProxy wayToProxy(const LightCaches& caches, const SkinWeights& weights, glm::vec3 position,
                      const ProxyOf& proxyOf) {
    glm::vec3 place(0);
    float distance = 0; // of the proxies from their caches, on average
    for (std::size_t i = 0; i < weights.count; ++i) {
        const glm::vec3 proxy = proxyOf(weights.cache[i]).position;
        place += weights.weight[i] * proxy;
        distance += weights.weight[i] * glm::distance(proxy, caches.position[weights.cache[i]]);
    }
    const glm::vec3 way = place - position;
    const float length = std::max(glm::length(way), kTiny);
    const float r = std::max({length, kNearestProxy * distance, kTiny});
    return {way / length, 1 / (4 * kPartPi * r * r)};
}

} // namespace

SkinWeights skinWeights(const LightCaches& caches, std::span<const std::uint32_t> list,
                        glm::vec3 position, glm::vec3 normal) {
    return weightsOf(caches, list, position,
                     [&](std::uint32_t c) { return glm::dot(normal, caches.normal[c]); });
}

SkinWeights glossyWeights(const LightCaches& caches, std::span<const std::uint32_t> list,
                          glm::vec3 position, glm::vec3 normal, glm::vec3 eye) {
    const glm::vec3 mirrored = mirroredWay(position, normal, eye);
    return weightsOf(caches, list, position, [&](std::uint32_t c) {
        return glm::dot(mirrored, mirroredWay(caches.position[c], caches.normal[c], eye));
    });
}

/// The caches in the list of a point; returns their number.
static std::size_t listOf(const LightCaches& caches, const FieldPoint& point,
                          std::array<std::uint32_t, NearestCaches::kLength>& list) {
    if (point.instance >= point.scene.instances.size())
        return 0;
    return caches.find({.instance = point.instance,
                        .triangle = point.triangle,
                        .u = point.u,
                        .v = point.v,
                        .position = point.position,
                        .normal = point.surfaceNormal(),
                        .mesh = &point.scene.meshOf(point.scene.instances[point.instance])},
                       list);
}

void SkinPart::irradianceTaps(const FieldPoint& point, FieldTaps& taps) const {
    const LightCaches& caches = *m_light.caches;
    std::array<std::uint32_t, NearestCaches::kLength> list;
    const std::size_t count = listOf(caches, point, list);
    const SkinWeights weights =
        skinWeights(caches, {list.data(), count}, point.position, point.normal);
    if (weights.count == 0)
        return;
    const WayToProxy way =
        wayToProxy(caches, weights, point.position, [&](std::uint32_t c) -> const ProxyLight& {
            return m_light.proxies[c].diffuse;
        });
    const float perFlux = way.perFlux * std::max(glm::dot(way.direction, point.normal), 0.f);
    if (perFlux > 0)
        for (std::size_t i = 0; i < weights.count; ++i)
            taps.push_back({weights.cache[i], weights.weight[i] * perFlux});
}

void SkinPart::radianceTaps(const FieldPoint& point, glm::vec3 /*direction*/,
                            FieldTaps& taps) const {
    const std::size_t first = taps.size();
    irradianceTaps(point, taps);
    for (std::size_t i = first; i < taps.size(); ++i)
        taps[i].weight /= kPartPi;
}

void SkinPart::lobeTaps(const FieldPoint& point, glm::vec3 /*direction*/, int /*bands*/,
                        const std::array<float, kMaxBands>& /*factors*/, FieldTaps& taps) const {
    if (!m_light.eye)
        return;
    const LightCaches& caches = *m_light.caches;
    std::array<std::uint32_t, NearestCaches::kLength> list;
    const std::size_t count = listOf(caches, point, list);
    const SkinWeights weights =
        glossyWeights(caches, {list.data(), count}, point.position, point.normal, *m_light.eye);
    if (weights.count == 0)
        return;
    const WayToProxy way =
        wayToProxy(caches, weights, point.position,
                   [&](std::uint32_t c) -> const ProxyLight& { return m_light.proxies[c].glossy; });
    const float roughness = surfaceGloss(point.scene, point.scene.instances[point.instance],
                                         point.triangle, point.u, point.v)
                                .roughness;
    const float perFlux =
        way.perFlux * std::max(glm::dot(way.direction, point.normal), 0.f) *
        glossLobe(glossExponent(roughness), mirroredWay(point.position, point.normal, *m_light.eye),
                  way.direction);
    if (perFlux > 0)
        for (std::size_t i = 0; i < weights.count; ++i)
            taps.push_back(
                {std::uint32_t(caches.size()) + weights.cache[i], weights.weight[i] * perFlux});
}

glm::vec3 SkinPart::sum(std::span<const FieldTap> taps) const {
    glm::vec3 sum(0);
    for (const FieldTap& tap : taps)
        sum += tap.weight * m_light.flux[tap.index];
    return sum;
}

bool SkinPart::equals(const FieldPart& other) const {
    const auto* skin = dynamic_cast<const SkinPart*>(&other);
    if (!skin)
        return false;
    const auto samePlace = [](const CacheProxies& a, const CacheProxies& b) {
        return a.diffuse.position == b.diffuse.position && a.glossy.position == b.glossy.position;
    };
    return skin->m_light.caches->position == m_light.caches->position &&
           skin->m_light.caches->normal == m_light.caches->normal &&
           skin->m_light.eye == m_light.eye && skin->m_light.flux == m_light.flux &&
           std::ranges::equal(skin->m_light.proxies, m_light.proxies, samePlace);
}

} // namespace limn
