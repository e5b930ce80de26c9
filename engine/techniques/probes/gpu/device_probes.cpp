// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/gpu/device_probes.h"

#include "engine/core/parallel.h"
#include "engine/core/stopwatch.h"
#include "engine/field/field_packing.h"
#include "engine/techniques/probes/gpu/marched_pass.h"
#include "engine/techniques/probes/probe_overlay.h"
#include "engine/techniques/probes/probe_planes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <glm/packing.hpp>

namespace limn {

using shared::GpuProbeHit;

Result<std::unique_ptr<DeviceProbes>> DeviceProbes::create(gpu::Device& device,
                                                           Viewport& viewport) {
    if (const auto bindings = device.checkStorageBuffers(GpuProbes::kStorageBuffers); !bindings)
        return tl::make_unexpected(bindings.error());
    return std::unique_ptr<DeviceProbes>(new DeviceProbes(device, viewport));
}

/// Takes over what changed in the scene. Returns whether there is any probe.
bool DeviceProbes::followScene(const Scene& scene, const ProbeSettings& settings) {
    ProbeInputs now = inputsOf(scene, settings, m_inputs);
    const bool fresh = !sameLattice(now, m_inputs);
    if (fresh) {
        m_maps = emptyMaps(now.grid, now.side);
        m_solidAngles = m_maps.map.solidAngles();
        m_probeMaps.assign(now.grid.count(), 0);
        m_refreshedBy.assign(now.grid.count(), 0);
        m_next = 0;
        m_planes = {};
        m_gpu = now.grid.count() > 0 ? std::make_unique<GpuProbes>(m_device, now.grid, m_maps.map)
                                     : nullptr;
        m_lightStale = true;
    }
    if (!sameSurfaces(now, m_inputs)) {
        ++m_mapEdition;
        m_trace.reset();
    }
    m_materialsStale |=
        now.materials != m_inputs.materials || now.materialOf != m_inputs.materialOf;
    if (m_gpu && (fresh || now.sky != m_inputs.sky)) {
        m_gpu->setSky(now.sky);
        m_lightStale = true;
    }
    if (m_gpu && m_maps.moments.smooth != settings.smooth) {
        m_maps.moments.smooth = settings.smooth;
        m_gpu->setSmooth(settings.smooth);
        m_lightStale |= settings.bounces;
    }
    m_lightStale |= std::exchange(m_bouncing, settings.bounces) != settings.bounces;
    m_inputs = std::move(now);
    followReflections(settings.reflections && m_inputs.glossy);
    return m_gpu != nullptr;
}

/// Begins to keep maps for marched reflections, or ends it.
void DeviceProbes::followReflections(bool wanted) {
    const bool marched = m_gpu && m_gpu->setMarched(wanted);
    m_lacksReflections = m_gpu && wanted && !marched;
    if (!marched)
        m_reflections = nullptr;
    if (marched == (m_planes.side > 0))
        return;
    m_planes = marched ? emptyMarchedMaps(m_maps.grid.size, m_maps.grid.bounds, m_maps.map.side)
                       : MarchedMaps{};
    m_planes.radiance = {}; // the device has it
    m_planesStale = marched;
    m_lightStale = true;
    if (marched)
        m_reflections = std::make_shared<MarchedPass>(m_device, m_viewport, m_gpu->marched());
}

std::uint32_t DeviceProbes::countStale() const {
    return std::uint32_t(std::ranges::count_if(
        m_probeMaps, [&](std::uint32_t edition) { return edition != m_mapEdition; }));
}

/// Traces the maps of up to `maxProbes` probes whose surfaces moved, in turn. Returns these probes.
std::vector<std::uint32_t> DeviceProbes::traceMaps(const Scene& scene, std::uint32_t maxProbes,
                                                   const Progress& progress, Work& work) {
    std::vector<std::uint32_t> traced;
    const std::uint32_t count = m_maps.grid.count();
    for (std::uint32_t k = 0; k < count && traced.size() < maxProbes && !progress.cancelled();
         ++k) {
        const std::uint32_t p = m_next;
        m_next = (m_next + 1) % count;
        if (m_probeMaps[p] == m_mapEdition)
            continue;
        if (!m_trace)
            m_trace = std::make_unique<TraceScene>(scene);
        traceProbe(scene, *m_trace, p, m_maps);
        work.rays += m_maps.map.texels();
        m_probeMaps[p] = m_mapEdition;
        traced.push_back(p);
        progress.at("probes", float(k + 1) / float(count));
    }
    work.refreshed = std::uint32_t(traced.size());
    m_updates += traced.empty() ? 0 : 1;
    for (const std::uint32_t p : traced)
        m_refreshedBy[p] = m_updates;
    return traced;
}

/// What a probe sees in the direction of a texel, as the device reads it.
static GpuProbeHit packHit(const ProbeScene& in, std::uint32_t probe, std::uint32_t texel) {
    const ProbeHit& hit = in.maps.hits[std::size_t(probe) * in.maps.map.texels() + texel];
    GpuProbeHit out{.kind = PROBE_SEES_NOTHING};
    if (hit.side == kInSolid)
        return out;
    out.kind = hit.instance == ~0U ? PROBE_SEES_SKY : PROBE_SEES_SURFACE;
    if (out.kind == PROBE_SEES_SKY)
        return out;
    const MapPoint point = mapPoint(in, probe, texel);
    out.position = point.lit.position;
    out.normal = point.lit.normal;
    out.albedoRedGreen = glm::packUnorm2x16({point.albedo.r, point.albedo.g});
    out.albedoBlue = glm::packUnorm2x16({point.albedo.b, 0});
    out.emission = point.emission;
    return out;
}

void DeviceProbes::sendHits(const Scene& scene, const std::vector<std::uint32_t>& probes,
                            bool moved) {
    if (probes.empty())
        return;
    const std::size_t texels = m_maps.map.texels();
    const IndirectField none;
    const ProbeScene in{scene, *m_trace, m_maps, m_solidAngles, none};
    std::vector<GpuProbeHit> hits(probes.size() * texels);
    parallelRanges(hits.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            hits[k] = packHit(in, probes[k / texels], std::uint32_t(k % texels));
    });
    m_gpu->setHits(probes, hits, moved);
    m_lightStale = true;
}

/// Sends the planes of what some probes see, whose maps are current.
void DeviceProbes::sendPlanes(const Scene& scene, std::span<const std::uint32_t> probes) {
    parallelRanges(probes.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            writePlanes(scene, m_maps, probes[k], m_planes);
    });
    m_gpu->setPlanes(m_planes, probes);
}

/// Lights all probes once. Returns whether the light changed by more than the document tolerates,
/// so that another bounce is due.
bool DeviceProbes::bounce(const Scene& scene, Work& work) {
    const std::span<const glm::vec4> means = m_gpu->project(m_bouncing);
    work.light += m_gpu->projectMs;
    double sum = 0;
    m_brightest = 0;
    for (std::size_t p = 0; p < means.size(); ++p) {
        const glm::vec4 mean = means[p];
        m_brightest = std::max({m_brightest, mean.x, mean.y, mean.z});
        sum += m_maps.inSolid[p] ? 0. : double(mean.x) + double(mean.y) + double(mean.z);
    }
    const double change = std::abs(sum - std::exchange(m_before, sum));
    return m_bouncing && change > double(scene.relight.tolerance) / 100 * sum;
}

LightingReport DeviceProbes::report(const Work& work, double totalMs) const {
    const std::uint32_t stale = countStale();
    const auto solid =
        std::accumulate(m_maps.inSolid.begin(), m_maps.inSolid.end(), std::uint32_t(0));
    LightingReport report;
    report.steps = {
        {"probe_maps", "Maps", "Rays from probes that see moved surfaces, on the CPU", work.maps},
        {"probe_light", "Light of maps",
         "Shadow maps, lights onto what probes see, and projection onto harmonics", work.light},
        {"probe_field", "Field", "What the viewport samples", work.field}};
    report.counters = {
        {"probes", "Probes", "Probes of the lattice", double(m_maps.grid.count())},
        {"probes_in_solids", "Probes in solids", "Their light is not used", double(solid)},
        {"probes_refreshed", "Refreshed", "Probes whose maps this update traced",
         double(work.refreshed)},
        {"probes_stale", "Stale", "Probes whose maps are still of an earlier scene", double(stale)},
        {"rays", "Rays", "Traced by this update, on the CPU", double(work.rays)},
        {"lights_traced", "Lights recomputed",
         "Lights whose shadow maps were read, because they or an object moved",
         double(m_gpu->lightsComputed)},
        {"dispatches", "Dispatches", "Compute dispatches of this update; 0 when skipped",
         double(work.dispatches)},
        {"probe_bytes", "Memory", "Maps, moments and light of the probes, on the GPU",
         double(m_gpu->bytes()), CounterUnit::Bytes}};
    if (m_planes.side > 0)
        report.counters.push_back({"reflection_bytes", "Memory of reflections",
                                   "Planes and radiance of the maps' texels, on the GPU",
                                   double(m_gpu->marchedBytes()), CounterUnit::Bytes});
    if (m_lacksReflections)
        report.lacks = kLacksLargeMaps;
    report.totalMs = totalMs;
    report.bounces = work.bounces;
    report.whole = stale == 0;
    report.converged = stale == 0 && !m_lightStale;
    report.skipped = work.dispatches == 0;
    return report;
}

LightingReport DeviceProbes::update(const LightingInput& input, const Progress& progress) {
    Stopwatch total, watch;
    Work work;
    const ProbeSettings settings = probeSettingsOf(input.scene.technique);
    if (!followScene(input.scene, settings)) {
        m_viewport.setIndirect(IndirectField{});
        LightingReport nothing;
        nothing.converged = nothing.skipped = true;
        return nothing;
    }
    const std::uint64_t before = m_gpu->dispatches();
    const std::vector<std::uint32_t> traced =
        traceMaps(input.scene, input.view ? settings.perUpdate : ~0U, progress, work);
    work.maps = watch.lap();
    sendHits(input.scene, traced, true);
    if (!traced.empty())
        m_gpu->setMoments(m_maps.moments);
    std::vector<std::uint32_t> current; // besides those
    for (std::uint32_t p = 0; p < m_probeMaps.size() && (m_materialsStale || m_planesStale); ++p)
        if (m_probeMaps[p] == m_mapEdition && !std::ranges::count(traced, p))
            current.push_back(p);
    if (std::exchange(m_materialsStale, false))
        sendHits(input.scene, current, false);
    if (m_planes.side > 0) {
        sendPlanes(input.scene, traced);
        if (std::exchange(m_planesStale, false))
            sendPlanes(input.scene, current);
    }
    m_lightStale |= m_gpu->updateDirect(m_viewport.shadowedLights());
    work.light = watch.lap();
    const std::uint32_t maxBounces =
        input.view || countStale() > 0 ? 1 : std::max(input.bounces, 1U);
    const bool lit = m_lightStale;
    while (m_lightStale && work.bounces < maxBounces &&
           !(work.bounces > 0 && progress.cancelled())) {
        m_lightStale = bounce(input.scene, work);
        ++work.bounces;
    }
    if (lit) {
        // No harmonic of three bands exceeds the constant one by more than the root of 5, nor does
        // its coefficient, as radiance is not negative.
        const float brightest = 2.24f * m_brightest;
        const float scale = m_gpu->field()->scale;
        m_gpu->writeField(scaleServes(scale, brightest) ? scale : fieldScale(brightest));
        work.field = m_gpu->fieldMs;
    }
    m_viewport.setIndirect(m_gpu->field(), m_reflections);
    work.dispatches = m_gpu->dispatches() - before;
    return report(work, total.lap());
}

IndirectField DeviceProbes::readField() const {
    if (!m_gpu)
        return {};
    IndirectField out = limn::readField(m_device, *m_gpu->field());
    out.lightmapWidth = out.lightmapHeight = 0; // a black texel, for shaders to bind
    out.lightmap.clear();
    out.gridMoments = std::make_shared<const GridMoments>(m_maps.moments);
    return out;
}

std::shared_ptr<const LightSnapshot> DeviceProbes::snapshot() const {
    if (!m_gpu)
        return nullptr;
    LitProbes lit{m_maps, m_gpu->readLight(), std::vector<ProbeAge>(m_probeMaps.size())};
    for (std::size_t p = 0; p < lit.ages.size(); ++p)
        lit.ages[p] = {.updates = m_updates - m_refreshedBy[p],
                       .stale = m_probeMaps[p] != m_mapEdition,
                       .lit = m_refreshedBy[p] > 0};
    return std::make_shared<const ProbeSnapshot>(std::move(lit));
}

Result<std::unique_ptr<Lighting>> lightProbesOnDevice(gpu::Device& device, Viewport& viewport,
                                                      const Prepared&) {
    return DeviceProbes::create(device, viewport);
}

} // namespace limn
