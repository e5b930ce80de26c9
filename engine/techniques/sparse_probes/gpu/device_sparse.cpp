// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/gpu/device_sparse.h"

#include "engine/core/stopwatch.h"
#include "engine/field/field_packing.h"
#include "engine/field/grid_placement.h"
#include "engine/gpu/barrier.h"
#include "engine/gpu/storage_maker.h"
#include "engine/techniques/sparse_probes/prepared_sparse.h"
#include "engine/techniques/sparse_probes/relight_rays.h"
#include "engine/techniques/sparse_probes/sparse_overlay.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace limn {

static constexpr std::uint32_t kMaxSteps = 3;

DeviceSparse::DeviceSparse(gpu::Device& device, Viewport& viewport,
                           std::shared_ptr<const SparseBake> bake, const Scene& scene,
                           SparseBuffers buffers, std::vector<glm::vec3> directions,
                           std::vector<float> basis)
    : m_device(device), m_viewport(viewport), m_bake(std::move(bake)),
      m_buffers(std::move(buffers)), m_steps(device, *m_bake, m_buffers),
      m_direct(device, {.points = m_buffers.receivers.handle,
                        .stride = sizeof(shared::GpuReceiver) / sizeof(glm::vec4),
                        .irradiance = m_buffers.direct.handle,
                        .count = std::uint32_t(m_bake->receivers.size())}),
      m_times(device, kMaxSteps), m_area(areasOf(m_bake->receivers).total),
      m_directions(std::move(directions)), m_basis(std::move(basis)) {
    setGrid(needsGrid(scene, m_bake->lightmap));
}

Result<std::unique_ptr<DeviceSparse>> DeviceSparse::create(gpu::Device& device, Viewport& viewport,
                                                           std::shared_ptr<const SparseBake> bake,
                                                           const Scene& scene) {
    if (const auto bindings = device.checkStorageBuffers(SparseSteps::kStorageBuffers); !bindings)
        return tl::make_unexpected(bindings.error());
    std::vector<glm::vec3> directions = relightDirections(bake->sparse.rays);
    std::vector<float> basis = relightBasis(directions, int(bake->sparse.bands));
    auto buffers = createSparseBuffers(device, *bake, pointsOf(scene, bake->receivers),
                                       areasOf(bake->receivers).share, basis, SparseSteps::kLanes);
    if (!buffers)
        return tl::make_unexpected(buffers.error());
    return std::unique_ptr<DeviceSparse>(new DeviceSparse(device, viewport, std::move(bake), scene,
                                                          std::move(*buffers),
                                                          std::move(directions), std::move(basis)));
}

/// Creates a black field with the grid or without it, as SparseLighting's.
void DeviceSparse::setGrid(bool grid) {
    const glm::uvec3 size = grid ? m_bake->gridSize : glm::uvec3(0);
    if (m_field && m_field->gridSize == size)
        return;
    const std::uint32_t bands = size.x > 0 ? std::uint32_t(kIrradianceBands) : 2;
    m_field = createWrittenField(m_device, {.lightmapWidth = m_bake->lightmap.width,
                                            .lightmapHeight = m_bake->lightmap.height,
                                            .bands = bands,
                                            .chroma = bands,
                                            .gridSize = size,
                                            .gridBounds = m_bake->gridBounds});
    m_steps.setField(*m_field);
    m_fieldWritten = false;
}

static std::vector<glm::vec4> padded(const std::vector<glm::vec3>& values) {
    std::vector<glm::vec4> out;
    out.reserve(values.size());
    for (const glm::vec3 v : values)
        out.emplace_back(v, 0);
    return out;
}

/// Uploads materials and a sky that changed. Returns whether the materials had.
bool DeviceSparse::uploadInputs(const Scene& scene, Work& work) {
    Stopwatch watch;
    VkCommandBuffer cmd = VK_NULL_HANDLE;
    const auto send = [&](const gpu::Buffer& to, const std::vector<glm::vec4>& values) {
        if (values.empty())
            return;
        if (!cmd)
            cmd = m_device.begin("inputs of sparse probes");
        gpu::updateBuffer(m_device, cmd, to, 0, std::as_bytes(std::span(values)));
    };
    const bool materials = updateReceiverMaterials(m_bake->receivers, scene, m_materials);
    if (materials) {
        send(m_buffers.albedo, padded(m_materials.albedo));
        send(m_buffers.emission, padded(m_materials.emission));
    }
    if (!m_started || m_sky != scene.sky) {
        m_sky = scene.sky;
        m_brightestSky = 0;
        for (const glm::vec3 d : m_directions) {
            const glm::vec3 L = skyRadiance(m_sky, d);
            m_brightestSky = std::max({m_brightestSky, L.x, L.y, L.z});
        }
        send(m_buffers.sky,
             packProbes(gatherSky(*m_bake, m_directions, m_basis, m_sky), m_bake->coefficients()));
    }
    if (cmd)
        m_device.submit(cmd);
    work.upload = watch.lap();
    return materials;
}

/// Takes over what changed in the scene.
void DeviceSparse::followScene(const Scene& scene, Work& work) {
    const bool directChanged = m_direct.update(m_viewport.shadowedLights());
    const bool skyChanged = !m_started || m_sky != scene.sky;
    const bool materialsChanged = uploadInputs(scene, work);
    const bool clamp = clampsParts(scene.technique),
               clampChanged = std::exchange(m_clampParts, clamp) != clamp;
    m_started = true;
    if (noteChanges(skyChanged || clampChanged, directChanged || materialsChanged, scene.relight,
                    m_convergence))
        gpu::clearBuffers(m_device, {m_buffers.irradiance.handle});
}

/// One round: receivers send, probes see them, receivers gather the probes.
RoundChange DeviceSparse::bounce(Work& work) {
    m_device.immediate("bounce", [&](VkCommandBuffer cmd) {
        gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kComputeWrite); // after inputs were sent
        m_times.begin(cmd);
        m_steps.recordRadiosity(cmd);
        m_times.mark(cmd);
        m_steps.recordProbes(cmd);
        m_times.mark(cmd);
        m_steps.recordReceivers(cmd, m_clampParts);
        m_times.mark(cmd);
        gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kHostRead);
    });
    const std::span<const double> ms = m_times.steps();
    work.radiosity += ms[0];
    work.probes += ms[1];
    work.receivers += ms[2];
    ++work.bounces;
    RoundChange round; // summed in order, so that the same light gives the same bits
    m_brightest = 0;
    const std::size_t groups =
        (m_bake->receivers.size() + SparseSteps::kLanes - 1) / SparseSteps::kLanes;
    const auto* change = static_cast<const glm::vec4*>(m_buffers.change.mapped);
    const double flux = std::numbers::pi * m_area;
    for (std::size_t g = 0; g < groups; ++g) {
        round.change += flux * double(change[g].x);
        round.total += flux * double(change[g].y);
        round.relative += double(change[g].z);
        m_brightest = std::max(m_brightest, change[g].w);
    }
    return round;
}

void DeviceSparse::writeField(Work& work) {
    // The integral of |Y_i| is below sqrt(4 pi), so radiance L from all around gives a coefficient
    // of at most 3.55 L. What eight bands make of a step exceeds it by less than a factor of four.
    const float brightest = 4 * 3.55f * std::max(m_brightest, m_brightestSky);
    if (!scaleServes(m_field->scale, brightest))
        m_field->scale = fieldScale(brightest);
    m_device.immediate("field", [&](VkCommandBuffer cmd) {
        gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kComputeWrite);
        m_times.begin(cmd);
        m_steps.recordField(cmd, *m_field, m_field->scale);
        m_times.mark(cmd);
    });
    work.field = m_times.steps()[0];
    m_fieldWritten = true;
}

LightingReport DeviceSparse::report(const Work& work, double totalMs, bool skipped) const {
    const ViewportStats& drawn = m_viewport.stats();
    LightingReport report;
    report.steps = {
        {"direct", "Direct light", "Shadow maps, and lights onto texels by them",
         m_direct.ms + work.upload + (drawn.relightShadowMaps > 0 ? drawn.relightShadowMs : 0)},
        {"radiosity", "Radiosity", "What texels reflect and emit", work.radiosity},
        {"sparse_probes", "Probes", "Harmonics of what probes see", work.probes},
        {"receivers", "Receivers", "Irradiance of texels, from probes", work.receivers},
        {"field", "Field", "Lightmap and grid that the viewport samples", work.field}};
    const auto counter = [](const char* id, const char* label, const char* tooltip, double value) {
        return LightingCounter{id, label, tooltip, value};
    };
    const double texels = double(m_field->lightmap.width) * m_field->lightmap.height,
                 field = texels * fieldLayers(m_field->bands, m_field->chroma) * 8 +
                         double(m_field->grid.size);
    report.counters = {
        counter("probes", "Probes", "In the open air", double(m_bake->probes.size())),
        counter("receivers", "Receivers", "Lightmap texels", double(m_bake->receivers.size())),
        counter("lights_traced", "Lights recomputed",
                "Lights whose shadow maps were read, because they or an object moved",
                double(m_direct.lightsComputed)),
        counter("lights_off", "Lights off",
                "Off, black or out of reach of every surface: they cost nothing",
                double(drawn.lightsOff)),
        counter("probe_updates", "Probe updates", "Probes lit by this update, in all its bounces",
                double(work.bounces) * double(m_bake->probes.size())),
        counter("dispatches", "Dispatches", "Compute dispatches of this update; 0 when skipped",
                double(work.dispatches)),
        {"light_bytes", "Memory",
         "Transport, light of texels and probes, and the field, on the GPU",
         double(m_buffers.bytes() + m_direct.bytes()) + field, CounterUnit::Bytes}};
    report.totalMs = totalMs;
    report.bounces = work.bounces;
    report.converged = m_convergence.reached();
    report.diverges = m_convergence.grows();
    report.skipped = skipped;
    return report;
}

LightingReport DeviceSparse::update(const LightingInput& input, const Progress& progress) {
    Work work;
    Stopwatch watch;
    const std::uint64_t before = dispatches();
    followScene(input.scene, work);
    while (work.bounces < input.bounces && !m_convergence.reached() && !progress.cancelled())
        m_convergence.addRound(bounce(work));
    setGrid(input.unread || needsGrid(input.scene, m_bake->lightmap));
    const bool skipped = work.bounces == 0 && m_fieldWritten;
    if (!skipped)
        writeField(work);
    m_viewport.setIndirect(m_field);
    work.dispatches = dispatches() - before;
    return report(work, watch.lap(), skipped);
}

std::vector<glm::vec3> DeviceSparse::readIrradiance() const {
    std::vector<glm::vec4> colors(m_bake->receivers.size());
    if (!colors.empty())
        gpu::readBuffer(m_device, m_buffers.irradiance, std::as_writable_bytes(std::span(colors)));
    return {colors.begin(), colors.end()};
}

std::shared_ptr<const LightSnapshot> DeviceSparse::snapshot() const {
    std::vector<glm::vec4> rows(m_bake->probes.size() * probeRow(m_bake->coefficients()));
    if (!rows.empty())
        gpu::readBuffer(m_device, m_buffers.probes, std::as_writable_bytes(std::span(rows)));
    return std::make_shared<const SparseSnapshot>(unpackProbes(rows, m_bake->coefficients()));
}

IndirectField DeviceSparse::readField() const {
    return limn::readField(m_device, *m_field);
}

Result<std::unique_ptr<Lighting>> lightSparseOnDevice(gpu::Device& device, Viewport& viewport,
                                                      const Prepared& prepared) {
    return DeviceSparse::create(device, viewport,
                                static_cast<const PreparedSparse&>(*prepared.data).bake(),
                                *prepared.scene);
}

} // namespace limn
