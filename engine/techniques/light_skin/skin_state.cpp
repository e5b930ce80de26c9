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
    if (m_sampled.follow({m_objects.surfaces(), s.all ? std::nullopt : now.view, s.samples, s.all,
                          s.visibleCaches})) {
        m_samples = {};
        if (!s.all && now.view && s.visibleCaches) {
            const CachesInView caches = cachesInView(*m_objects.caches(), *now.view);
            m_samples = seenCaches(trace(), scene, caches, *now.view);
            cost.rays += caches.size();
        } else if (!s.all && now.view) {
            m_samples = samplesOfView(trace(), scene, *now.view, s.samples);
            cost.rays += s.samples;
        } else if (!s.all) {
            m_samples = samplesOfSurfaces(scene, s.samples);
        }
    }
    m_choice.follow({m_sampled.version, s.vals, s.defence, s.all});
    cost.importanceMs += clock.lap();
}

void SkinState::choose(const SkinInputs& now, const RsmSource& source, SkinCost& cost) {
    Stopwatch clock;
    const SkinSettings& s = now.settings;
    SkinLight& light = *std::ranges::find(m_lights, source.shape, &SkinLight::shape);
    const bool all = s.all || light.lights.size() <= s.vals;
    if (!all && light.importanceOf != m_sampled.version) {
        light.importance =
            importances(light.lights, m_samples, nearestSample(m_objects.caches()->diagonal));
        light.importanceOf = m_sampled.version;
    }
    cost.importanceMs += clock.lap();
    const bool changed = light.chosenOf != m_choice.version;
    ChosenLights chosen;
    if (all) {
        m_draws.erase(source.index);
        if (!changed) // the choice of all lights does not change with the view
            return;
        chosen = allLights(light.lights);
    } else {
        KeptDraws& kept = m_draws[source.index];
        if (changed || kept.shape != light.shape)
            kept.renewal.begin({light.shape.kind, light.lights.columns, light.lights.rows,
                                m_sources, s, now.view.has_value()});
        else if (!kept.renewal.isDue())
            return;
        kept.shape = light.shape;
        drawLights(light.lights, light.importance, {.count = s.vals, .defence = s.defence},
                   kept.renewal.next(), kept.draws);
        chosen = drawnLights(light.lights, kept.draws);
    }
    if (light.chosenOf == 0 || chosen.light != light.chosen.light ||
        chosen.weight != light.chosen.weight) {
        light.chosen = std::move(chosen);
        light.sumsOf = 0;
    }
    light.chosenOf = m_choice.version;
    cost.choiceMs += clock.lap();
}

/// Chooses for all lights that shine, once for those of the same shape.
void SkinState::chooseAll(const SkinInputs& now, SkinCost& cost) {
    m_sources = std::uint32_t(now.sources.size());
    std::erase_if(m_draws, [&](const auto& kept) {
        return std::ranges::find(now.sources, kept.first, &RsmSource::index) == now.sources.end();
    });
    for (const RsmSource& source : now.sources)
        if (std::ranges::find(now.sources, source.shape, &RsmSource::shape)->index == source.index)
            choose(now, source, cost);
}

bool SkinState::isRenewing() const {
    return std::ranges::any_of(m_draws,
                               [](const auto& kept) { return kept.second.renewal.isDue(); });
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
    chooseAll(now, cost);
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
    for (const auto& [index, kept] : m_draws)
        bytes += kept.draws.cell.size() * (sizeof(std::uint32_t) + sizeof(double));
    return bytes;
}

} // namespace limn
