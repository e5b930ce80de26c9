// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/gpu/device_lpv.h"

#include "engine/core/stopwatch.h"
#include "engine/lighting/relight.h"
#include "engine/rsm/rsm_inputs.h"
#include "engine/scene/light/unit_light.h"
#include "engine/techniques/lpv/lpv_overlay.h"

#include <algorithm>
#include <span>
#include <utility>

namespace limn {

Result<std::unique_ptr<DeviceLpv>> DeviceLpv::create(gpu::Device& device, Viewport& viewport) {
    auto gpu = GpuPropagation::create(device);
    if (!gpu)
        return tl::make_unexpected(gpu.error());
    return std::unique_ptr<DeviceLpv>(new DeviceLpv(device, viewport, std::move(*gpu)));
}

LightingReport DeviceLpv::update(const LightingInput& input, const Progress& progress) {
    Stopwatch whole;
    Cost cost;
    LightingReport report =
        relightUnlessSame(lpvInputsOf(input.scene), m_inputs, false, [&](const LpvInputs& now) {
            if (!relight(input.scene, now, progress, cost))
                return Relit::Cancelled;
            m_scene = input.scene;
            return Relit::Whole;
        });
    if (m_gpu->field())
        m_viewport.setIndirect(m_gpu->field());
    describe(cost, report);
    report.lacks = sourcesLeftOut(input.scene, {.emitters = true, .profiles = false});
    report.totalMs = whole.lap();
    return report;
}

/// Sends blockers and emitters that the device does not have.
void DeviceLpv::upload(Cost& cost) {
    Stopwatch clock;
    if (m_surfacesSent != m_sources->surfacesVersion()) {
        m_lights.clear();
        cost.bytesUploaded += m_gpu->setLattice(m_sources->lattice(), m_sources->blockers());
        m_surfacesSent = m_sources->surfacesVersion();
    }
    if (m_emittersSent != m_sources->emittersVersion()) {
        m_emitters = m_gpu->upload(m_sources->emitters());
        cost.bytesUploaded += m_emitters.cells.size;
        m_emittersSent = m_sources->emittersVersion();
    }
    cost.uploadMs = clock.lap();
}

const GpuLobes* DeviceLpv::lobesOf(const Light& shape) const {
    const auto it = std::ranges::find(m_lights, shape, &Kept::shape);
    return it == m_lights.end() ? nullptr : &it->lobes;
}

/// Draws the maps of lights that have none. False if cancelled.
bool DeviceLpv::castMaps(const Scene& scene, const LpvInputs& now, const Progress& progress,
                         Cost& cost) {
    Stopwatch clock;
    const std::uint64_t dispatchesBefore = m_maps.dispatches();
    std::erase_if(m_lights, [&](const Kept& kept) {
        return std::ranges::none_of(
            scene.lights, [&](const Light& light) { return unitLight(light) == kept.shape; });
    });
    for (const RsmSource& source : now.sources) {
        if (lobesOf(source.shape))
            continue;
        if (progress.cancelled())
            return false;
        MappedLight mapped =
            m_maps.cast(source.shape, scene.bounds, now.settings.mapSize, m_sources->lattice());
        cost.views += mapped.views;
        ++cost.traced;
        m_lights.push_back({source.shape, m_gpu->lobesOf(std::move(mapped.cells), mapped.count)});
    }
    cost.mapDispatches = m_maps.dispatches() - dispatchesBefore;
    cost.mapMs += clock.lap();
    return true;
}

/// False if cancelled.
bool DeviceLpv::relight(const Scene& scene, const LpvInputs& now, const Progress& progress,
                        Cost& cost) {
    m_sources->followSurfaces(scene, now, cost);
    upload(cost);
    if (!castMaps(scene, now, progress, cost))
        return false;
    std::vector<GpuSource> sources = {{&m_emitters, glm::vec3(1)}};
    for (const RsmSource& source : now.sources)
        sources.push_back({lobesOf(source.shape), source.colour});
    const bool dark = now.sources.empty() && m_sources->emitters().empty();
    cost.rounds = dark ? 0 : now.settings.rounds;
    return m_gpu->light(sources, std::uint32_t(cost.rounds),
                        fieldFactors(now.settings.fluxLookup, m_sources->lattice().cell), progress,
                        cost);
}

std::shared_ptr<const LightSnapshot> DeviceLpv::snapshot() const {
    if (!m_inputs)
        return nullptr;
    std::optional<TraceScene> trace;
    LpvSourceCost cost;
    m_sources->followLights(
        m_scene, *m_inputs,
        [&]() -> const TraceScene& { return trace ? *trace : trace.emplace(m_scene); }, {}, cost);
    LitLattice lit = m_sources->lit(m_inputs->sources, m_inputs->settings.rounds);
    lit.sum = m_gpu->readSum();
    return std::make_shared<const LpvSnapshot>(std::move(lit));
}

void DeviceLpv::describe(const Cost& cost, LightingReport& report) const {
    describeSources(*m_sources, cost, cost.rounds, report);
    report.steps.push_back({"injection", "Injection",
                            "Upload of what changed, and the sum of all lights in cells",
                            cost.uploadMs + cost.injectionMs});
    report.steps.push_back(
        {"propagation", "Propagation", "Light moves from cell to cell", cost.propagationMs});
    report.steps.push_back({"field", "Field", "What the viewport samples", cost.fieldMs});
    std::uint64_t bytes = m_gpu->bytes() + m_maps.bytes() + m_emitters.cells.size;
    for (const Kept& light : m_lights)
        bytes += light.lobes.cells.size;
    report.counters.push_back(
        {"map_views", "Shadow map views", "Views drawn for shadow maps", double(cost.views)});
    report.counters.push_back({"dispatches", "Dispatches", "Compute dispatches of the device",
                               double(cost.mapDispatches + cost.dispatches)});
    report.counters.push_back({"bytes_uploaded", "Bytes uploaded",
                               "Blockers and emitters sent to the device: those that changed",
                               double(cost.bytesUploaded)});
    report.counters.push_back(
        {"bytes", "Memory",
         "Volumes of light and blockers, injected light, images of shadow maps and the field",
         double(bytes), CounterUnit::Bytes});
}

Result<std::unique_ptr<Lighting>> lightLpvOnDevice(gpu::Device& device, Viewport& viewport,
                                                   const Prepared& /*prepared*/) {
    return DeviceLpv::create(device, viewport);
}

} // namespace limn
