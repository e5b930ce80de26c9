// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/skin_objects.h"

#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"

#include <utility>

#include <glm/common.hpp>

namespace limn {

/// Largest flux of a proxy, so that sums stay within float.
static constexpr double kMaxProxyFlux = 1e34;

bool SkinObjects::follow(const Scene& scene, const SkinInputs& now, SkinCost& cost) {
    Stopwatch clock;
    const SkinLayout layout{now.settings.spacing, now.settings.angle, now.settings.vertexLists};
    const bool changed = m_surfaces.follow({now.surfaces, layout, now.settings.mapSize});
    if (changed) {
        m_discs.reset();
        m_caches = std::make_shared<const LightCaches>(m_skins.place(scene, layout));
        m_discs.emplace(*m_caches);
        cost.meshes += m_skins.made();
    }
    const glm::vec3* eye = now.eye();
    if (m_gathering.follow(
            {m_surfaces.version, now.gloss, eye ? std::optional(*eye) : std::nullopt}))
        m_exponents = eye ? glossExponents(scene, *m_caches) : std::vector<float>();
    cost.cacheMs += clock.lap();
    return changed;
}

bool SkinObjects::place(const SkinInputs& now, std::span<const GatheredSource> sources,
                        std::uint64_t gathers, const Progress& progress, SkinCost& cost) {
    Stopwatch clock;
    ProxyKey key{.gathers = gathers, .shade = now.settings.shade};
    for (const GatheredSource& source : sources)
        key.shapes.push_back(*source.shape);
    if (m_placed == key && m_proxies.size() == m_caches->size())
        return true;
    m_placed.reset();
    m_proxies.assign(m_caches->size(), {});
    const glm::vec3* eye = now.eye();
    parallelRanges(m_proxies.size(), 64, [&](std::size_t begin, std::size_t end) {
        std::vector<ProxySums> diffuse(sources.size()), glossy(sources.size());
        for (std::size_t c = begin; c < end; ++c) {
            for (std::size_t i = 0; i < sources.size(); ++i) {
                diffuse[i] = (*sources[i].sums)[c].diffuse;
                glossy[i] = (*sources[i].sums)[c].glossy;
            }
            const GatheringCache cache = gatheringCache(*m_caches, m_exponents, eye, c);
            m_proxies[c].diffuse = diffuseProxy(cache, diffuse);
            if (eye)
                m_proxies[c].glossy = glossyProxy(cache, glossy);
        }
    });
    if (now.settings.shade)
        shadeProxies(*m_caches, *m_discs, m_proxies, progress);
    if (progress.cancelled())
        return false;
    m_placed = std::move(key);
    cost.shadeMs += clock.lap();
    return true;
}

/// Flux of a proxy whose cache receives that light.
static glm::vec3 fluxOf(const ProxyLight& proxy, glm::dvec3 light) {
    const double perLight = double(proxy.fluxOfLight) * double(proxy.lit);
    return glm::vec3(glm::min(light * perLight, glm::dvec3(kMaxProxyFlux)));
}

std::vector<glm::vec3> SkinObjects::fluxes(std::span<const GatheredSource> sources) const {
    const std::size_t count = m_caches->size();
    std::vector<glm::vec3> flux(2 * count);
    for (std::size_t c = 0; c < count; ++c) {
        glm::dvec3 diffuse(0), glossy(0);
        for (const GatheredSource& source : sources) {
            const CacheSums& sums = (*source.sums)[c];
            diffuse += glm::dvec3(source.colour) * glm::dvec3(sums.diffuse.light);
            glossy += glm::dvec3(source.colour) * glm::dvec3(sums.glossy.light);
        }
        flux[c] = fluxOf(m_proxies[c].diffuse, diffuse);
        flux[count + c] = fluxOf(m_proxies[c].glossy, glossy);
    }
    return flux;
}

std::uint64_t SkinObjects::bytes() const {
    if (!m_caches)
        return 0;
    return m_caches->bytes() + m_discs->bytes() + m_exponents.size() * sizeof(float) +
           m_proxies.size() * sizeof(CacheProxies);
}

} // namespace limn
