// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/skin_state.h"

#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/scene/light/unit_light.h"

#include <algorithm>
#include <utility>

#include <glm/common.hpp>

namespace limn {

/// Distance below which lights beside a view sample count alike, as a share of the diagonal.
static constexpr float kNearestSample = 1 / 30.f;
/// Largest flux of a proxy, so that sums stay within float.
static constexpr double kMaxProxyFlux = 1e34;

void SkinState::followSurfaces(const Scene& scene, const SkinInputs& now, SkinCost& cost) {
    Stopwatch clock;
    const SkinLayout layout{now.settings.spacing, now.settings.angle, now.settings.vertexLists};
    if (m_surfaces.follow({now.surfaces, layout, now.settings.mapSize})) {
        m_discs.reset();
        m_caches = std::make_shared<const LightCaches>(m_skins.place(scene, layout));
        m_discs.emplace(*m_caches);
        m_diagonal = skinDiagonal(scene);
        m_lights.clear();
        cost.meshes += m_skins.made();
    }
    cost.cacheMs += clock.lap();
}

void SkinState::followSamples(const Scene& scene, const SkinInputs& now, const TraceOf& trace,
                              SkinCost& cost) {
    Stopwatch clock;
    const SkinSettings& s = now.settings;
    if (m_sampled.follow({m_surfaces.version, s.all ? std::nullopt : now.view, s.samples, s.all})) {
        m_samples = {};
        if (!s.all && now.view) {
            m_samples = samplesOfView(trace(), scene, *now.view, s.samples);
            cost.rays += s.samples;
        } else if (!s.all) {
            m_samples = samplesOfSurfaces(scene, s.samples);
        }
    }
    m_choice.follow({m_sampled.version, s.vals, s.defence, s.all});
    cost.importanceMs += clock.lap();
}

void SkinState::choose(const SkinInputs& now, SkinLight& light, SkinCost& cost) {
    Stopwatch clock;
    const SkinSettings& s = now.settings;
    const bool all = s.all || light.lights.size() <= s.vals;
    if (!all && light.importanceOf != m_sampled.version) {
        light.importance =
            importances(light.lights, m_samples, std::max(kNearestSample * m_diagonal, 1e-20f));
        light.importanceOf = m_sampled.version;
    }
    cost.importanceMs += clock.lap();
    // The choice of all lights does not change with the view.
    if (light.chosenOf == m_choice.version)
        return;
    ChosenLights chosen =
        all ? allLights(light.lights)
            : chooseLights(light.lights, light.importance, {.count = s.vals, .defence = s.defence});
    if (light.chosenOf == 0 || chosen.light != light.chosen.light ||
        chosen.weight != light.chosen.weight) {
        light.chosen = std::move(chosen);
        light.sumsOf = 0;
    }
    light.chosenOf = m_choice.version;
    cost.choiceMs += clock.lap();
}

bool SkinState::gather(const Scene& scene, const SkinInputs& now, const Progress& progress,
                       SkinCost& cost) {
    Stopwatch clock;
    const std::optional<glm::vec3> eye =
        now.isGlossy() ? std::optional(now.view->camera.eye) : std::nullopt;
    if (m_gather.follow({m_surfaces.version, now.gloss, eye}))
        m_exponents = eye ? glossExponents(scene, *m_caches) : std::vector<float>();
    for (const RsmSource& source : now.sources) {
        SkinLight& light = *std::ranges::find(m_lights, source.shape, &SkinLight::shape);
        if (light.sumsOf == m_gather.version)
            continue;
        light.sumsOf = 0;
        gatherLights(*m_caches, m_exponents, gatheringLights(light.lights, light.chosen),
                     eye ? &*eye : nullptr, light.sums, progress);
        if (progress.cancelled())
            return false;
        light.sumsOf = m_gather.version;
        ++m_gathers;
        ++cost.gathered;
    }
    cost.gatherMs += clock.lap();
    return true;
}

bool SkinState::castLights(const Scene& scene, const SkinInputs& now, const TraceOf& trace,
                           const Progress& progress, SkinCost& cost) {
    Stopwatch clock;
    std::erase_if(m_lights, [&](const SkinLight& kept) {
        return std::ranges::none_of(
            scene.lights, [&](const Light& light) { return unitLight(light) == kept.shape; });
    });
    for (const RsmSource& source : now.sources) {
        if (lightOf(source.shape))
            continue;
        SkinLight light{.shape = source.shape,
                        .lights = castVirtualLights(trace(), scene, source.shape,
                                                    now.settings.mapSize, progress)};
        if (progress.cancelled())
            return false;
        cost.rays += light.lights.rays;
        ++cost.traced;
        m_lights.push_back(std::move(light));
    }
    cost.mapMs += clock.lap();
    return true;
}

bool SkinState::placeProxies(const SkinInputs& now, const Progress& progress, SkinCost& cost) {
    Stopwatch clock;
    ProxyKey key{.gathers = m_gathers, .shade = now.settings.shade};
    std::vector<const SkinLight*> lights;
    for (const RsmSource& source : now.sources) {
        key.shapes.push_back(source.shape);
        lights.push_back(lightOf(source.shape));
    }
    if (m_placed == key && m_proxies.size() == m_caches->size())
        return true;
    m_placed.reset();
    m_proxies.assign(m_caches->size(), {});
    const glm::vec3* eye = now.isGlossy() ? &now.view->camera.eye : nullptr;
    parallelRanges(m_proxies.size(), 64, [&](std::size_t begin, std::size_t end) {
        std::vector<ProxySums> diffuse(lights.size()), glossy(lights.size());
        for (std::size_t c = begin; c < end; ++c) {
            for (std::size_t i = 0; i < lights.size(); ++i) {
                diffuse[i] = lights[i]->sums[c].diffuse;
                glossy[i] = lights[i]->sums[c].glossy;
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

bool SkinState::follow(const Scene& scene, const SkinInputs& now, const TraceOf& trace,
                       const Progress& progress, SkinCost& cost) {
    followSurfaces(scene, now, cost);
    if (!castLights(scene, now, trace, progress, cost))
        return false;
    followSamples(scene, now, trace, cost);
    for (const RsmSource& source : now.sources)
        choose(now, *std::ranges::find(m_lights, source.shape, &SkinLight::shape), cost);
    return gather(scene, now, progress, cost) && placeProxies(now, progress, cost);
}

const SkinLight* SkinState::lightOf(const Light& shape) const {
    const auto it = std::ranges::find(m_lights, shape, &SkinLight::shape);
    return it == m_lights.end() ? nullptr : &*it;
}

/// Flux of a proxy whose cache receives that light.
static glm::vec3 fluxOf(const ProxyLight& proxy, glm::dvec3 light) {
    const double perLight = double(proxy.fluxOfLight) * double(proxy.lit);
    return glm::vec3(glm::min(light * perLight, glm::dvec3(kMaxProxyFlux)));
}

std::vector<glm::vec3> SkinState::fluxes(std::span<const RsmSource> sources) const {
    const std::size_t count = m_caches->size();
    std::vector<glm::vec3> flux(2 * count);
    for (std::size_t c = 0; c < count; ++c) {
        glm::dvec3 diffuse(0), glossy(0);
        for (const RsmSource& source : sources) {
            const CacheSums& sums = lightOf(source.shape)->sums[c];
            diffuse += glm::dvec3(source.colour) * glm::dvec3(sums.diffuse.light);
            glossy += glm::dvec3(source.colour) * glm::dvec3(sums.glossy.light);
        }
        flux[c] = fluxOf(m_proxies[c].diffuse, diffuse);
        flux[count + c] = fluxOf(m_proxies[c].glossy, glossy);
    }
    return flux;
}

std::uint64_t SkinLight::bytes() const {
    return lights.bytes() + importance.size() * sizeof(float) +
           chosen.light.size() * (sizeof(std::uint32_t) + sizeof(float)) +
           sums.size() * sizeof(CacheSums);
}

std::uint64_t SkinState::bytes() const {
    std::uint64_t bytes = 0;
    if (m_caches)
        bytes += m_caches->bytes() + m_discs->bytes();
    for (const SkinLight& light : m_lights)
        bytes += light.bytes();
    return bytes + m_exponents.size() * sizeof(float) + m_samples.size() * 2 * sizeof(glm::vec3) +
           m_proxies.size() * sizeof(CacheProxies);
}

} // namespace limn
