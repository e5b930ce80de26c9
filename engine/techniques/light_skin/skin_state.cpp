// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/skin_state.h"

#include "engine/core/stopwatch.h"
#include "engine/scene/light/unit_light.h"

#include <algorithm>
#include <utility>

namespace limn {

void SkinState::followSamples(const Scene& scene, const SkinInputs& now, const TraceOf& trace,
                              SkinCost& cost) {
    Stopwatch clock;
    const SkinSettings& s = now.settings;
    if (m_sampled.follow(
            {m_objects.surfaces(), s.all ? std::nullopt : now.view, s.samples, s.all})) {
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
            importances(light.lights, m_samples, nearestSample(m_objects.caches()->diagonal));
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

bool SkinState::gather(const SkinInputs& now, const Progress& progress, SkinCost& cost) {
    Stopwatch clock;
    for (const RsmSource& source : now.sources) {
        SkinLight& light = *std::ranges::find(m_lights, source.shape, &SkinLight::shape);
        if (light.sumsOf == m_objects.gathering())
            continue;
        light.sumsOf = 0;
        gatherLights(*m_objects.caches(), m_objects.exponents(),
                     gatheringLights(light.lights, light.chosen, m_objects.caches()->diagonal),
                     now.eye(), light.sums, progress);
        if (progress.cancelled())
            return false;
        light.sumsOf = m_objects.gathering();
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

bool SkinState::follow(const Scene& scene, const SkinInputs& now, const TraceOf& trace,
                       const Progress& progress, SkinCost& cost) {
    if (m_objects.follow(scene, now, cost))
        m_lights.clear();
    if (!castLights(scene, now, trace, progress, cost))
        return false;
    followSamples(scene, now, trace, cost);
    for (const RsmSource& source : now.sources)
        choose(now, *std::ranges::find(m_lights, source.shape, &SkinLight::shape), cost);
    return gather(now, progress, cost) &&
           m_objects.place(now, gathered(now.sources), m_gathers, progress, cost);
}

const SkinLight* SkinState::lightOf(const Light& shape) const {
    const auto it = std::ranges::find(m_lights, shape, &SkinLight::shape);
    return it == m_lights.end() ? nullptr : &*it;
}

std::vector<GatheredSource> SkinState::gathered(std::span<const RsmSource> sources) const {
    std::vector<GatheredSource> all;
    for (const RsmSource& source : sources) {
        const SkinLight* light = lightOf(source.shape);
        all.push_back({&light->shape, source.colour, &light->sums});
    }
    return all;
}

std::uint64_t SkinLight::bytes() const {
    return lights.bytes() + importance.size() * sizeof(float) +
           chosen.light.size() * (sizeof(std::uint32_t) + sizeof(float)) +
           sums.size() * sizeof(CacheSums);
}

std::uint64_t SkinState::bytes() const {
    std::uint64_t bytes = m_objects.bytes() + m_samples.size() * 2 * sizeof(glm::vec3);
    for (const SkinLight& light : m_lights)
        bytes += light.bytes();
    return bytes;
}

} // namespace limn
