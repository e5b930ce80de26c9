// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/light_skin/gather_light.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A point light that stands for all light which a cache receives of one kind.
struct ProxyLight {
    glm::vec3 position{0};  ///< [m]
    glm::vec3 deviation{0}; ///< of the virtual lights' positions, along each axis [m]
    /// Flux per irradiance, or per reflected radiance, of the cache: 4 pi r^2 over the factors of
    /// the cosines [m^2]. 0: it stands for no light.
    float fluxOfLight = 0;
    float lit = 1; ///< share of the flux that no disc takes

    /// Radius of the sphere around all it stands for [m].
    float radius() const;
};

/// Both proxies of a cache.
struct CacheProxies {
    ProxyLight diffuse, glossy;
};

/// Smallest cosine between a cache's normal and the way to its proxy: the proxy moves along the
/// normal until it has that. Smallest factor of a lobe by which light is divided.
inline constexpr float kMinProxyCosine = 0.05f, kMinProxyLobe = 1e-3f;

/// Diffuse proxy of a cache for the sum of what it receives of all lights that shine: flux 4 pi E
/// r^2 / cos+ lights it with E. Bischoff, Schwandt, Broll. 2017, equations 5 and 7, without the
/// reflectance, which cancels.
ProxyLight diffuseProxy(const GatheringCache& cache, std::span<const ProxySums> ofLights);

/// The same for its glossy proxy: flux 4 pi G r^2 / ((k + 2) / 2 pi cos^k cos+).
ProxyLight glossyProxy(const GatheringCache& cache, std::span<const ProxySums> ofLights);

/// Lobe (k + 2) / 2 pi cos^k of a direction about a mirrored one, both unit [sr^-1].
float glossLobe(float exponent, glm::vec3 mirrored, glm::vec3 direction);

} // namespace limn
