// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/gpu/device_photons.h"

#include "engine/core/stopwatch.h"
#include "engine/techniques/photon_lattices/gpu/photon_pass.h"
#include "engine/techniques/photon_lattices/photon_sources.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace limn {

namespace {

using shared::GpuBounce;

/// The rest of a path whose first bounce the device made. What it absorbed is counted here.
std::optional<PathStart> startOf(const GpuBounce& bounce, std::uint32_t sample,
                                 const PhotonScene& scene, PhotonMap& map) {
    if (!(bounce.incident > 0))
        return std::nullopt;
    const auto event = PhotonEvent(bounce.event & PHOTON_EVENTS);
    const bool diffuse = event == PhotonEvent::Diffuse;
    const double power = 3 * double(bounce.incident);
    const auto over = [&](std::uint64_t& paths, double& fate) {
        ++map.fates.emitted;
        ++paths;
        map.fates.emittedPower += power;
        fate += power;
        return std::nullopt;
    };
    if ((bounce.event & PHOTON_EVENTS) == 0)
        return over(map.fates.absorbed, map.fates.absorbedPower);
    if (!diffuse && scene.settings.specular == 0)
        return over(map.fates.ended, map.fates.endedPower);
    map.vertices.push_back({.position = bounce.position,
                            .instance = bounce.instance,
                            .event = event,
                            .narrow = (bounce.event & PHOTON_NARROW) != 0});
    const float side = event == PhotonEvent::Transmitted ? -1.f : 1.f;
    return PathStart{
        .flight = {.origin = scene.trace.clearOf(bounce.position, side * bounce.normal),
                   .direction = bounce.direction,
                   .power = bounce.power,
                   .vertex = std::uint32_t(map.vertices.size() - 1),
                   .diffuse = diffuse ? 1U : 0U,
                   .specular = diffuse ? 0U : 1U},
        .surface = {},
        .sample = sample};
}

} // namespace

/// The structure that an update brings, or one that is made here, once for each change of objects.
const TraceScene& DevicePhotons::traceOf(const LightingInput& input) {
    if (input.trace)
        return *input.trace;
    const Scene& now = input.scene;
    const auto same = [&](bool dynamicToo) {
        if (!m_trace || m_trace->scene().assets != now.assets ||
            m_trace->scene().instances.size() != now.instances.size())
            return false;
        const Scene& before = m_trace->scene();
        for (std::size_t i = 0; i < now.instances.size(); ++i) {
            const Instance &a = before.instances[i], &b = now.instances[i];
            const Material &m = before.materialOf(a), &n = now.materialOf(b);
            const bool sameHoles =
                alphaCutoff(m) == alphaCutoff(n) && isGlassSheet(m) == isGlassSheet(n) &&
                m.baseColor.w == n.baseColor.w && m.baseColorTexture == n.baseColorTexture;
            if (a.dynamic != b.dynamic || a.mesh != b.mesh || !sameHoles ||
                (a.toWorld != b.toWorld && (dynamicToo || !a.dynamic)))
                return false;
        }
        return true;
    };
    if (same(false)) {
        if (!same(true))
            m_trace = std::make_unique<TraceScene>(now, *m_trace);
    } else {
        m_trace = std::make_unique<TraceScene>(now);
    }
    return *m_trace;
}

PhotonMap DevicePhotons::traceLight(const LightingInput& input, const Light& light,
                                    const PathSettings& settings, const Progress& progress) {
    const std::uint32_t side = photonMapSide(light, input.scene.bounds, settings.photons);
    const auto bounces = profileOf(light) // maps that the device draws know no profiles
                             ? std::nullopt
                             : m_bounces.bounce(input.scene, light, side);
    const PhotonScene scene{traceOf(input), input.scene, settings};
    if (!bounces)
        return limn::traceLight(scene, light, progress);
    return tracePaths(
        scene, std::uint32_t(bounces->size()),
        [&](std::uint32_t path, PhotonMap& map) {
            return startOf((*bounces)[path], path, scene, map);
        },
        progress);
}

LightingReport DevicePhotons::update(const LightingInput& input, const Progress& progress) {
    Stopwatch whole;
    const std::uint64_t dispatches = m_bounces.dispatches(), views = m_bounces.views();
    LightingReport report = m_live.update(
        input.scene,
        [&](const PhotonSource& source, const PathSettings& settings, const Progress& reported) {
            if (source.origin == PhotonOrigin::Light)
                return traceLight(input, source.shape, settings, reported);
            return tracePhotons({traceOf(input), input.scene, settings}, source, reported);
        },
        progress);
    Stopwatch clock;
    std::uint64_t uploaded = 0;
    if (m_shown != m_live.field().version) {
        m_shown = m_live.field().version;
        m_pass = photonPass(m_device, m_viewport, m_live.field());
        uploaded = m_pass->bytes();
    }
    if (m_pass)
        m_viewport.setIndirect(m_pass);
    report.steps.push_back({"upload", "Upload", "Lattices sent to the device", clock.lap()});
    report.counters.push_back({"map_views", "Shadow map views", "Views drawn for shadow maps",
                               double(m_bounces.views() - views)});
    report.counters.push_back({"dispatches", "Dispatches", "Compute dispatches of the device",
                               double(m_bounces.dispatches() - dispatches)});
    report.counters.push_back({"bytes_uploaded", "Bytes uploaded",
                               "Lattices sent to the device: none unless they changed",
                               double(uploaded)});
    report.counters.push_back({"device_bytes", "Memory of the device",
                               "Lattices, and the images and bounces of shadow maps",
                               double((m_pass ? m_pass->bytes() : 0) + m_bounces.bytes()),
                               CounterUnit::Bytes});
    report.totalMs = whole.lap();
    return report;
}

Result<std::unique_ptr<Lighting>> lightPhotonsOnDevice(gpu::Device& device, Viewport& viewport,
                                                       const Prepared& /*prepared*/) {
    return std::make_unique<DevicePhotons>(device, viewport);
}

} // namespace limn
