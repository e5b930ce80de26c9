// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/volume_sources.h"

#include "engine/core/stopwatch.h"
#include "engine/scene/light/unit_light.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace limn {

namespace {

/// The settings on which area lights depend.
auto mapSettings(const VolumeSettings& s) {
    return std::tuple(s.map, s.read, s.level);
}

/// The settings on which places of caches depend.
auto cacheSettings(const VolumeSettings& s) {
    return std::tuple(s.cascades, s.nodes, s.caches, s.transition);
}

} // namespace

VolumeInputs volumeInputsOf(const LightingInput& input, const std::optional<VolumeInputs>& before) {
    VolumeInputs now{.surfaces = rsmSurfacesOf(input.scene),
                     .settings = volumeSettingsOf(input.scene.technique),
                     .sources = rsmSourcesOf(input.scene)};
    if (input.view)
        now.view = *input.view;
    if (now.settings.freeze && before && before->view)
        now.view = before->view;
    return now;
}

VolumeChanges changesOf(const std::optional<VolumeInputs>& before, const VolumeInputs& now) {
    if (!before || before->surfaces != now.surfaces)
        return {};
    return {.maps = mapSettings(before->settings) != mapSettings(now.settings),
            .voxels = before->settings.voxels != now.settings.voxels,
            .caches = before->view != now.view ||
                      cacheSettings(before->settings) != cacheSettings(now.settings)};
}

bool VolumeSources::follow(const TraceScene& trace, const Scene& scene, const VolumeInputs& now,
                           const Progress& progress, VolumeSourceCost& cost) {
    Stopwatch clock;
    const VolumeChanges changes = changesOf(m_before, now);
    if (changes.maps)
        m_lights.clear();
    if (changes.voxels)
        m_voxels.outdate();
    m_cachesCurrent &= !changes.caches;
    m_before = now;
    if (!followLights(trace, scene, now, progress, cost))
        return false;
    cost.mapMs += clock.lap();
    m_voxels.follow(scene, now.settings);
    cost.voxelMs += clock.lap();
    if (!m_cachesCurrent) {
        CacheAllocation made =
            now.view ? allocateForView(trace, scene, *now.view, now.settings, progress)
                     : allocateForScene(scene, now.settings);
        if (progress.cancelled())
            return false;
        cost.viewRays = made.rays;
        m_caches = std::make_shared<const CacheAllocation>(std::move(made));
        m_cachesCurrent = true;
    }
    cost.allocationMs += clock.lap();
    return true;
}

bool VolumeSources::followLights(const TraceScene& trace, const Scene& scene,
                                 const VolumeInputs& now, const Progress& progress,
                                 VolumeSourceCost& cost) {
    std::erase_if(m_lights, [&](const auto& kept) {
        return std::ranges::none_of(
            scene.lights, [&](const Light& light) { return unitLight(light) == kept->shape; });
    });
    const AreaLightOptions options{now.settings.map, now.settings.read, now.settings.level};
    for (const RsmSource& source : now.sources) {
        if (std::ranges::any_of(m_lights,
                                [&](const auto& kept) { return kept->shape == source.shape; }))
            continue;
        AreaLights made = areaLightsOf(trace, scene, source.shape, options, progress);
        if (progress.cancelled())
            return false;
        cost.mapRays += made.rays;
        ++cost.traced;
        m_lights.push_back(std::make_shared<const AreaLights>(std::move(made)));
    }
    return true;
}

std::vector<std::shared_ptr<const AreaLights>>
VolumeSources::areaLights(const std::vector<RsmSource>& sources) const {
    std::vector<std::shared_ptr<const AreaLights>> all;
    for (const RsmSource& source : sources)
        all.push_back(*std::ranges::find_if(
            m_lights, [&](const auto& kept) { return kept->shape == source.shape; }));
    return all;
}

} // namespace limn
