// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/proxy_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace limn {

static constexpr float kProxyPi = std::numbers::pi_v<float>;

float ProxyLight::radius() const {
    return 2 * std::max({deviation.x, deviation.y, deviation.z});
}

/// The way from the cache, with a cosine of at least kMinProxyCosine.
static glm::dvec3 aboveHorizon(glm::dvec3 way, glm::vec3 normal) {
    const glm::dvec3 n(normal);
    const double up = glm::dot(way, n);
    const glm::dvec3 along = way - n * up;
    const double cosine = double(kMinProxyCosine);
    const double height = glm::length(along) * cosine / std::sqrt(1 - cosine * cosine);
    return up < height ? along + n * height : way;
}

/// Position and deviation of a proxy; fluxOfLight is 4 pi r^2 / cos+.
static ProxyLight proxyOf(const GatheringCache& cache, std::span<const ProxySums> ofLights) {
    double weight = 0;
    glm::dvec3 first(0), second(0);
    for (const ProxySums& sums : ofLights) {
        weight += double(sums.weight);
        first += glm::dvec3(sums.first);
        second += glm::dvec3(sums.second);
    }
    ProxyLight proxy{.position = cache.position + cache.normal};
    if (!(weight > 0))
        return proxy;
    const glm::dvec3 mean = first / weight;
    proxy.deviation = glm::vec3(glm::sqrt(glm::max(second / weight - mean * mean, glm::dvec3(0))));
    const glm::dvec3 way = aboveHorizon(mean, cache.normal);
    const double r = glm::length(way);
    if (!(r > 0)) // all of it lies at the cache
        return proxy;
    proxy.position = cache.position + glm::vec3(way);
    proxy.fluxOfLight =
        float(4 * std::numbers::pi * r * r * r / glm::dot(way, glm::dvec3(cache.normal)));
    return proxy;
}

ProxyLight diffuseProxy(const GatheringCache& cache, std::span<const ProxySums> ofLights) {
    return proxyOf(cache, ofLights);
}

float glossLobe(float exponent, glm::vec3 mirrored, glm::vec3 direction) {
    const float cosine = std::max(glm::dot(mirrored, direction), 0.f);
    return (exponent + 2) / (2 * kProxyPi) * std::pow(std::min(cosine, 1.f), exponent);
}

ProxyLight glossyProxy(const GatheringCache& cache, std::span<const ProxySums> ofLights) {
    ProxyLight proxy = proxyOf(cache, ofLights);
    if (!(proxy.fluxOfLight > 0))
        return proxy;
    const glm::vec3 direction = glm::normalize(proxy.position - cache.position);
    const float minLobe = kMinProxyLobe * (cache.exponent + 2) / (2 * kProxyPi);
    proxy.fluxOfLight /= std::max(glossLobe(cache.exponent, cache.mirrored, direction), minLobe);
    return proxy;
}

} // namespace limn
