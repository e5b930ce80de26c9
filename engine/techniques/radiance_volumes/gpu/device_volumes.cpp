// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/gpu/device_volumes.h"

#include "engine/core/stopwatch.h"
#include "engine/gpu/uploader.h"
#include "engine/lighting/relight.h"
#include "engine/rsm/rsm_inputs.h"
#include "engine/scene/light/unit_light.h"
#include "engine/techniques/radiance_volumes/volume_overlay.h"

#include <algorithm>
#include <span>
#include <utility>

namespace limn {

DeviceVolumes::DeviceVolumes(gpu::Device& device, Viewport& viewport)
    : m_device(device), m_viewport(viewport), m_maps(device, viewport),
      m_allocation(device, viewport), m_light(device) {}

LightingReport DeviceVolumes::update(const LightingInput& input, const Progress& progress) {
    Stopwatch whole;
    Cost cost;
    const std::uint64_t before = dispatches();
    LightingReport report =
        relightUnlessSame(volumeInputsOf(input, m_followed), m_inputs, m_voxels.fading(),
                          [&](const VolumeInputs& now) {
                              if (!relight(input.scene, now, progress, cost))
                                  return Relit::Cancelled;
                              m_scene = input.scene;
                              return m_voxels.fading() ? Relit::InPart : Relit::Whole;
                          });
    cost.dispatches = dispatches() - before;
    if (m_pass)
        m_viewport.setIndirect(m_pass);
    describe(cost, report);
    report.lacks = m_lacks ? m_lacks : sourcesLeftOut(input.scene, {.profiles = false});
    report.totalMs = whole.lap();
    return report;
}

const GpuAreaLights* DeviceVolumes::lightsOf(const Light& shape) const {
    const auto it = std::ranges::find(m_lights, shape, &GpuAreaLights::shape);
    return it == m_lights.end() ? nullptr : &*it;
}

/// Draws the maps of lights that have none. False if cancelled.
bool DeviceVolumes::castMaps(const Scene& scene, const VolumeInputs& now, const Progress& progress,
                             Cost& cost) {
    std::erase_if(m_lights, [&](const GpuAreaLights& kept) {
        return std::ranges::none_of(
            scene.lights, [&](const Light& light) { return unitLight(light) == kept.shape; });
    });
    for (const RsmSource& source : now.sources) {
        if (lightsOf(source.shape))
            continue;
        if (progress.cancelled())
            return false;
        m_lights.push_back(m_maps.cast(source.shape, scene.bounds,
                                       {now.settings.map, now.settings.read, now.settings.level}));
        cost.views += m_lights.back().views;
        ++cost.traced;
    }
    return true;
}

void DeviceVolumes::placeCaches(const Scene& scene, const VolumeInputs& now) {
    std::optional<CacheAllocation> made =
        now.view ? m_allocation.allocate(scene, *now.view, now.settings)
                 : allocateForScene(scene, now.settings);
    if (!made)
        m_lacks = "all light: this device cannot bind as many nodes";
    m_caches = std::make_shared<const CacheAllocation>(made ? std::move(*made) : CacheAllocation());
    m_address.reset();
    if (!m_caches->address.empty())
        m_address = std::make_shared<const gpu::Buffer>(gpu::Uploader(m_device).buffer(
            std::as_bytes(std::span(m_caches->address)), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
            "addresses of caches"));
}

/// False if cancelled.
bool DeviceVolumes::relight(const Scene& scene, const VolumeInputs& now, const Progress& progress,
                            Cost& cost) {
    Stopwatch clock;
    const VolumeChanges changes = changesOf(m_followed, now);
    m_lacks = nullptr;
    if (changes.maps)
        m_lights.clear();
    if (changes.voxels)
        m_voxels.outdate();
    if (changes.caches)
        m_caches.reset();
    m_followed = now;
    if (!castMaps(scene, now, progress, cost))
        return false;
    cost.mapMs = clock.lap();
    if (m_voxels.follow(scene, now.settings) && m_voxels.shown() &&
        !m_light.setVoxels(*m_voxels.shown())) {
        m_voxels.reset();
        m_lacks = "shadows: this device cannot bind as many voxels";
    }
    cost.voxelMs = clock.lap();
    if (!m_caches)
        placeCaches(scene, now);
    cost.allocationMs = clock.lap();
    if (progress.cancelled())
        return false;
    std::vector<GpuLitAreaLights> lit;
    for (const RsmSource& source : now.sources)
        lit.push_back({lightsOf(source.shape), source.colour});
    GpuCacheLightInput input{.lights = lit,
                             .shadows = m_voxels.shown() ? now.settings.shadow : ConeShadows::None,
                             .bands = now.settings.bands};
    if (now.settings.glossy && now.view) {
        input.glossy =
            GlossyMapShape{now.settings.tile, now.settings.fill, now.settings.microfacet};
        input.eye = now.view->camera.eye;
    }
    GpuCachesLight light = m_light.light(m_caches->places, input);
    if (input.glossy && !light.glossy && !lit.empty())
        m_lacks = "maps for reflections: this device cannot bind as many";
    m_glossy = light.glossy ? input.glossy : std::nullopt;
    m_eye = input.eye;
    auto volume = std::make_shared<GpuVolume>();
    volume->grids = gpuCacheGrids(m_caches->grids, m_glossy, m_eye);
    volume->grids.clamped = now.settings.clamp ? 1 : 0;
    volume->bands = now.settings.bands;
    volume->harmonics = std::move(light.harmonics);
    volume->glossy = std::move(light.glossy);
    volume->address = m_address;
    m_pass = std::make_shared<VolumePass>(m_device, m_viewport, volume);
    m_volume = std::move(volume);
    cost.lightMs = clock.lap();
    return true;
}

std::shared_ptr<const VolumePart> DeviceVolumes::readPart() const {
    auto part = std::make_shared<VolumePart>();
    part->caches = m_caches;
    part->bands = m_volume->bands;
    part->clamped = m_volume->grids.clamped == 1;
    part->light.harmonics.resize(m_caches->caches() * part->coefficients());
    if (m_volume->harmonics)
        gpu::readBuffer(m_device, m_volume->harmonics,
                        std::as_writable_bytes(std::span(part->light.harmonics)));
    part->glossy = m_glossy;
    part->eye = m_eye;
    if (m_glossy) {
        part->light.glossy.resize(m_caches->caches() * m_glossy->texels());
        gpu::readBuffer(m_device, m_volume->glossy,
                        std::as_writable_bytes(std::span(part->light.glossy)));
    }
    return part;
}

IndirectField DeviceVolumes::readField() const {
    IndirectField field;
    if (!m_volume)
        return field;
    field.bands = m_volume->bands;
    field.parts = {readPart()};
    field.version = 1;
    return field;
}

std::shared_ptr<const LightSnapshot> DeviceVolumes::snapshot() const {
    if (!m_inputs)
        return nullptr;
    const TraceScene trace(m_scene);
    VolumeInputs inputs = *m_inputs;
    inputs.view.reset(); // the caches are the device's, and so are the voxels
    inputs.settings.shadow = ConeShadows::None;
    VolumeSourceCost cost;
    m_onCpu.follow(trace, m_scene, inputs, {}, cost);
    return std::make_shared<const VolumeSnapshot>(
        LitVolume{.settings = m_inputs->settings,
                  .part = readPart(),
                  .voxels = m_voxels.shown(),
                  .sources = inputs.sources,
                  .lights = m_onCpu.areaLights(inputs.sources)});
}

void DeviceVolumes::describe(const Cost& cost, LightingReport& report) const {
    describeVolume(m_caches.get(), m_voxels.shown().get(), cost, report);
    std::uint64_t bytes = m_maps.bytes() + m_allocation.bytes() + m_light.bytes();
    for (const GpuAreaLights& lights : m_lights)
        bytes += lights.lights.size + lights.blocks.size;
    if (m_pass)
        bytes += m_pass->bytes();
    report.counters.push_back(
        {"views", "Views drawn", "Views of lights that were drawn for maps", double(cost.views)});
    report.counters.push_back(
        {"dispatches", "Dispatches", "Compute dispatches of the update", double(cost.dispatches)});
    report.counters.push_back({"bytes", "Memory",
                               "On the device: caches, their addresses, area lights, voxels, maps",
                               double(bytes), CounterUnit::Bytes});
}

Result<std::unique_ptr<Lighting>> lightVolumesOnDevice(gpu::Device& device, Viewport& viewport,
                                                       const Prepared& /*prepared*/) {
    return std::unique_ptr<Lighting>(std::make_unique<DeviceVolumes>(device, viewport));
}

} // namespace limn
