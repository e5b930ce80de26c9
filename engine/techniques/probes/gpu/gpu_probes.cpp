// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/gpu/gpu_probes.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/storage_maker.h"
#include "shaders/probes/probe_field.comp.h"
#include "shaders/probes/probe_levels.comp.h"
#include "shaders/probes/probe_light.comp.h"

#include <algorithm>
#include <cassert>

namespace limn {

using shared::GpuProbeHit;
using shared::GpuProbeRange;

namespace {

constexpr VkDescriptorType kBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
constexpr std::uint32_t kLanes = 64, kCoefficients = PROBE_COEFFICIENTS;
static_assert(kCoefficients == std::tuple_size_v<ProbeHarmonics>);

gpu::Buffer storage(gpu::Device& device, VkDeviceSize bytes, const char* name,
                    gpu::MemoryKind memory = gpu::MemoryKind::Gpu) {
    return {device,
            {.size = bytes,
             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                      VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
             .memory = memory,
             .name = name}};
}

/// Harmonics of each texel's direction times its solid angle.
std::vector<float> basisOf(Octahedron map) {
    const std::vector<float> solidAngles = map.solidAngles();
    std::vector<float> basis;
    for (std::uint32_t t = 0; t < map.texels(); ++t) {
        float y[kCoefficients];
        shBasis(kIrradianceBands, map.direction(t), y);
        for (const float value : y)
            basis.push_back(value * solidAngles[t]);
    }
    return basis;
}

} // namespace

GpuProbes::GpuProbes(gpu::Device& device, const ProbeGrid& grid, Octahedron map)
    : m_device(device), m_grid(grid), m_map(map), m_times(device, 1) {
    assert(grid.count() > 0);
    const VkDeviceSize color = sizeof(glm::vec4), probes = grid.count();
    m_sky = storage(device, map.texels() * color, "sky of maps");
    const std::vector<float> basis = basisOf(map);
    m_basis = gpu::Uploader(device).buffer(std::as_bytes(std::span(basis)),
                                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "basis of maps");
    m_means = storage(device, probes * color, "means of probes", gpu::MemoryKind::Readback);
    for (gpu::Buffer& light : m_light)
        light = storage(device, probes * kCoefficients * color, "light of probes");
    createBlocks();
    gpu::clearBuffers(device, {m_sky.handle, m_light[0].handle, m_light[1].handle});
    createSets();
    setMoments({.texels = std::vector<glm::vec2>(probes * kGridDepthTexels, glm::vec2(0))});
}

void GpuProbes::createBlocks() {
    const std::uint32_t texels = m_map.texels();
    const std::size_t maxProbes =
        m_device.properties.limits.maxStorageBufferRange / (texels * sizeof(GpuProbeHit));
    const auto step = std::uint32_t(std::clamp<std::size_t>(maxProbes, 1, m_grid.count()));
    for (std::uint32_t begin = 0; begin < m_grid.count(); begin += step) {
        Block block{.begin = begin, .end = std::min(begin + step, m_grid.count())};
        const VkDeviceSize hits = VkDeviceSize(block.end - begin) * texels;
        block.hits = storage(m_device, hits * sizeof(GpuProbeHit), "hits of probes");
        block.direct = storage(m_device, hits * sizeof(glm::vec4), "direct light of hits");
        gpu::clearBuffers(m_device, {block.hits.handle, block.direct.handle});
        block.irradiance = std::make_unique<PointIrradiance>(
            m_device, PointBuffers{.points = block.hits.handle,
                                   .stride = sizeof(GpuProbeHit) / sizeof(glm::vec4),
                                   .irradiance = block.direct.handle,
                                   .count = std::uint32_t(hits)});
        m_blocks.push_back(std::move(block));
    }
}

void GpuProbes::createSets() {
    std::array<VkDescriptorType, PROBE_BINDINGS> types;
    types.fill(kBuffer);
    m_setLayout = gpu::createSetLayout(m_device, types);
    m_pool = gpu::createDescriptorPool(m_device, std::uint32_t(2 * m_blocks.size()), types);
    for (Block& block : m_blocks)
        for (std::size_t k = 0; k < 2; ++k) {
            block.sets[k] = gpu::allocateSet(m_device, m_pool, m_setLayout);
            const auto write = [&](std::uint32_t binding, const gpu::Buffer& buffer) {
                gpu::writeBuffer(m_device, block.sets[k], binding, kBuffer, buffer.handle);
            };
            write(PROBE_HITS, block.hits);
            write(PROBE_DIRECT, block.direct);
            write(PROBE_BEFORE, m_light[1 - k]);
            write(PROBE_LIGHT, m_light[k]);
        }
    forSets(PROBE_SKY, m_sky.handle);
    forSets(PROBE_BASIS, m_basis.handle);
    forSets(PROBE_MEANS, m_means.handle);
    forSets(PROBE_RADIANCE, m_means.handle); // to bind something; not written
    const std::array layouts = {m_setLayout.handle};
    m_layout = gpu::createPipelineLayout(m_device, layouts, sizeof(GpuProbeRange), "probes");
    const std::array constants = {kLanes, m_map.texels(), std::uint32_t(kIrradianceBands)};
    m_project = gpu::createComputePipeline(m_device, kProbeLightComp, m_layout.handle, constants,
                                           "light of probes");
    m_writeField = gpu::createComputePipeline(m_device, kProbeFieldComp, m_layout.handle, constants,
                                              "field of probes");
    m_writeLevel = gpu::createComputePipeline(m_device, kProbeLevelsComp, m_layout.handle,
                                              constants, "radiance of probes");
}

void GpuProbes::forSets(std::uint32_t binding, VkBuffer buffer) {
    for (const Block& block : m_blocks)
        for (const VkDescriptorSet set : block.sets)
            gpu::writeBuffer(m_device, set, binding, kBuffer, buffer);
}

void GpuProbes::setHits(std::span<const std::uint32_t> probes, std::span<const GpuProbeHit> hits,
                        bool moved) {
    const std::size_t texels = m_map.texels();
    assert(hits.size() == probes.size() * texels);
    if (probes.empty())
        return;
    const VkCommandBuffer cmd = m_device.begin("maps of probes");
    for (Block& block : m_blocks) {
        bool any = false;
        for (std::size_t k = 0; k < probes.size(); ++k) {
            if (probes[k] < block.begin || probes[k] >= block.end)
                continue;
            gpu::updateBuffer(m_device, cmd, block.hits,
                              (probes[k] - block.begin) * texels * sizeof(GpuProbeHit),
                              std::as_bytes(hits.subspan(k * texels, texels)));
            any = true;
        }
        if (any && moved)
            block.irradiance->pointsChanged();
    }
    m_device.submit(cmd);
}

void GpuProbes::setMoments(const GridMoments& moments) {
    assert(moments.texels.size() == std::size_t(m_grid.count()) * kGridDepthTexels);
    m_moments = std::make_shared<const gpu::Buffer>(
        gpu::Uploader(m_device).buffer(std::as_bytes(std::span(moments.texels)),
                                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "moments of probes"));
    m_field = createWrittenField(
        m_device, {.gridSize = m_grid.size, .gridBounds = m_grid.bounds, .gridDepth = m_moments});
    forSets(PROBE_MOMENTS, m_moments->handle);
    forSets(PROBE_GRID, m_field->grid.handle);
    setSmooth(m_smooth);
}

void GpuProbes::setSmooth(bool smooth) {
    m_smooth = smooth;
    m_field->gridWeights = smooth ? GRID_SMOOTH_MOMENTS : GRID_MOMENTS;
}

bool GpuProbes::setMarched(bool marched) {
    if (marched != (m_marched != nullptr)) {
        m_marched = marched ? createMarchedMaps(m_device, m_grid.count(), m_map.side) : nullptr;
        forSets(PROBE_RADIANCE, m_marched ? m_marched->radiance.handle : m_means.handle);
    }
    return m_marched != nullptr;
}

void GpuProbes::setPlanes(const MarchedMaps& maps, std::span<const std::uint32_t> probes) {
    assert(m_marched);
    uploadMarchedPlanes(m_device, maps, probes, *m_marched);
}

void GpuProbes::setSky(const Sky& sky) {
    std::vector<glm::vec4> radiance;
    for (std::uint32_t t = 0; t < m_map.texels(); ++t)
        radiance.emplace_back(skyRadiance(sky, m_map.direction(t)), 0);
    const VkCommandBuffer cmd = m_device.begin("sky of probes");
    gpu::updateBuffer(m_device, cmd, m_sky, 0, std::as_bytes(std::span(radiance)));
    m_device.submit(cmd);
}

bool GpuProbes::updateDirect(const ShadowedLights& lights) {
    bool computed = false;
    directMs = 0;
    lightsComputed = 0;
    for (Block& block : m_blocks) {
        computed |= block.irradiance->update(lights);
        directMs += block.irradiance->ms;
        lightsComputed = std::max(lightsComputed, block.irradiance->lightsComputed);
    }
    return computed;
}

GpuProbeRange GpuProbes::range(const Block& block, bool bounces) const {
    return {.gridLower = m_grid.bounds.lower,
            .begin = block.begin,
            .cellSize = m_grid.step(),
            .end = block.end,
            .gridSize = m_grid.size,
            .weights = bounces ? m_field->gridWeights : GRID_PLAIN,
            .fieldScale = 0,
            .marched = m_marched ? 1U : 0U};
}

void GpuProbes::dispatch(VkCommandBuffer cmd, const gpu::Pipeline& step, VkDescriptorSet set,
                         const GpuProbeRange& range, std::size_t groups) {
    m_dispatches += gpu::dispatch(m_device, cmd, step.handle, m_layout.handle, set,
                                  std::as_bytes(std::span(&range, 1)), groups);
}

std::span<const glm::vec4> GpuProbes::project(bool bounces) {
    m_written = 1 - m_written;
    m_device.immediate("light of probes", [&](VkCommandBuffer cmd) {
        gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kComputeWrite); // after inputs were sent
        gpu::memoryBarrier(cmd, gpu::kAllReads, gpu::kComputeWrite);  // of the radiance
        m_times.begin(cmd);
        for (const Block& block : m_blocks)
            dispatch(cmd, m_project, block.sets[m_written], range(block, bounces),
                     block.end - block.begin);
        m_times.mark(cmd);
        gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kHostRead);
    });
    projectMs = m_times.steps()[0];
    return {static_cast<const glm::vec4*>(m_means.mapped), m_grid.count()};
}

/// Records the coarser levels of the marched maps' radiance, if there are any.
void GpuProbes::writeLevels(VkCommandBuffer cmd) {
    GpuProbeRange all = range(m_blocks[0], false);
    all.end = m_grid.count();
    all.marched = 1;
    for (std::size_t side = m_marched ? m_map.side : 0; side > MARCH_COARSEST; ++all.marched) {
        side = (side + 1) / 2;
        dispatch(cmd, m_writeLevel, m_blocks[0].sets[m_written], all,
                 (m_grid.count() * side * side + kLanes - 1) / kLanes);
        gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kComputeWrite);
    }
}

void GpuProbes::writeField(float scale) {
    GpuProbeRange all = range(m_blocks[0], false);
    all.begin = 0;
    all.end = m_grid.count();
    all.fieldScale = scale;
    m_device.immediate("field", [&](VkCommandBuffer cmd) {
        gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kComputeWrite);
        m_times.begin(cmd);
        beginFieldWrite(cmd, *m_field);
        dispatch(cmd, m_writeField, m_blocks[0].sets[m_written], all,
                 (m_grid.count() + kLanes - 1) / kLanes);
        writeLevels(cmd);
        endFieldWrite(cmd, *m_field);
        m_times.mark(cmd);
    });
    m_field->scale = scale;
    fieldMs = m_times.steps()[0];
}

std::vector<ProbeHarmonics> GpuProbes::readLight() const {
    std::vector<glm::vec4> values(std::size_t(m_grid.count()) * kCoefficients);
    gpu::readBuffer(m_device, m_light[m_written], std::as_writable_bytes(std::span(values)));
    std::vector<ProbeHarmonics> light(m_grid.count());
    for (std::size_t k = 0; k < values.size(); ++k)
        light[k / kCoefficients][k % kCoefficients] = glm::vec3(values[k]);
    return light;
}

std::uint64_t GpuProbes::dispatches() const {
    std::uint64_t sum = m_dispatches;
    for (const Block& block : m_blocks)
        sum += block.irradiance->dispatches;
    return sum;
}

VkDeviceSize GpuProbes::bytes() const {
    VkDeviceSize sum = m_sky.size + m_basis.size + m_means.size + m_light[0].size +
                       m_light[1].size + m_moments->size + m_field->grid.size;
    for (const Block& block : m_blocks)
        sum += block.hits.size + block.direct.size + block.irradiance->bytes();
    return sum;
}

} // namespace limn
