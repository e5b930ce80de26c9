// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/gpu/sparse_steps.h"

#include "shaders/sparse_probes/sparse_clusters.comp.h"
#include "shaders/sparse_probes/sparse_grid.comp.h"
#include "shaders/sparse_probes/sparse_lightmap.comp.h"
#include "shaders/sparse_probes/sparse_probes.comp.h"
#include "shaders/sparse_probes/sparse_radiosity.comp.h"
#include "shaders/sparse_probes/sparse_receivers.comp.h"

#include <algorithm>
#include <array>

namespace limn {

using shared::GpuSparseRange;

namespace {

constexpr VkDescriptorType kBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;

std::size_t groupsOf(std::size_t items, std::size_t lanes) {
    return (items + lanes - 1) / lanes;
}

/// Number of values of all probes if they fit into shared memory beside what the clusters' step
/// keeps there, else 1. On a software rasteriser, whose shared memory is no faster than any other,
/// copying them there doubles the time of the step.
std::uint32_t cachedValues(const gpu::Device& device, const SparseBake& bake) {
    constexpr std::size_t kOthers =
        (SPARSE_CLUSTER_RECEIVERS + 1 + SparseSteps::kGatherLanes) * sizeof(glm::vec4);
    const std::size_t values = bake.probes.size() * probeRow(bake.coefficients());
    const bool fits =
        values * sizeof(glm::vec3) + kOthers <= device.properties.limits.maxComputeSharedMemorySize;
    return fits && values > 0 && !device.softwareRasteriser ? std::uint32_t(values) : 1;
}

} // namespace

SparseSteps::SparseSteps(gpu::Device& device, const SparseBake& bake, const SparseBuffers& buffers)
    : m_device(device), m_bake(bake), m_buffers(buffers), m_cached(cachedValues(device, bake)) {
    createSets();
    m_radiosity = pipeline(kSparseRadiosityComp, kLanes, "radiance of receivers");
    m_probes = pipeline(kSparseProbesComp, kLanes, "light probes");
    m_receivers = bake.compressed.empty()
                      ? pipeline(kSparseReceiversComp, kGatherLanes, "gather receivers")
                      : pipeline(kSparseClustersComp, kGatherLanes, "gather clusters");
    m_lightmap = pipeline(kSparseLightmapComp, kLanes, "write lightmap");
    m_grid = pipeline(kSparseGridComp, kLanes, "write grid");
}

void SparseSteps::createSets() {
    std::array<VkDescriptorType, SPARSE_BINDINGS> types;
    types.fill(kBuffer);
    types[SPARSE_LIGHTMAP] = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    m_setLayout = gpu::createSetLayout(m_device, types);
    const std::size_t count = std::max<std::size_t>(m_buffers.blocks.size(), 1);
    m_pool = gpu::createDescriptorPool(m_device, std::uint32_t(count), types);
    const SparseBuffers& b = m_buffers;
    for (std::size_t k = 0; k < count; ++k) {
        m_sets.push_back(gpu::allocateSet(m_device, m_pool, m_setLayout));
        const gpu::Buffer& transport = b.blocks.empty() ? b.near : b.blocks[k].transport;
        std::uint32_t binding = 0;
        for (const gpu::Buffer* buffer :
             {&b.receivers, &b.direct, &b.albedo, &b.emission, &b.irradiance, &b.radiance,
              &b.change, &b.hits, &b.basis, &b.sky, &b.probes, &b.near, &transport, &b.cells})
            gpu::writeBuffer(m_device, m_sets[k], binding++, kBuffer, buffer->handle);
    }
    const std::array layouts = {m_setLayout.handle};
    m_layout =
        gpu::createPipelineLayout(m_device, layouts, sizeof(GpuSparseRange), "sparse probes");
}

gpu::Pipeline SparseSteps::pipeline(gpu::Spirv shader, std::uint32_t lanes, const char* name) {
    const std::array constants = {lanes, std::uint32_t(m_bake.coefficients()), m_bake.sparse.rays,
                                  m_cached};
    return gpu::createComputePipeline(m_device, shader, m_layout.handle, constants, name);
}

void SparseSteps::setField(const GpuField& field) {
    for (const VkDescriptorSet set : m_sets) {
        gpu::writeBuffer(m_device, set, SPARSE_GRID, kBuffer, field.grid.handle);
        gpu::writeStorageImage(m_device, set, SPARSE_LIGHTMAP, field.lightmap.view);
    }
}

void SparseSteps::dispatch(VkCommandBuffer cmd, const gpu::Pipeline& step, VkDescriptorSet set,
                           const GpuSparseRange& range, std::size_t groups) {
    dispatches += gpu::dispatch(m_device, cmd, step.handle, m_layout.handle, set,
                                std::as_bytes(std::span(&range, 1)), groups);
}

void SparseSteps::recordRadiosity(VkCommandBuffer cmd) {
    const auto count = std::uint32_t(m_bake.receivers.size());
    dispatch(cmd, m_radiosity, m_sets[0], {0, count}, groupsOf(count, kLanes));
}

void SparseSteps::recordProbes(VkCommandBuffer cmd) {
    const auto count = std::uint32_t(m_bake.probes.size());
    dispatch(cmd, m_probes, m_sets[0], {0, count}, count);
}

void SparseSteps::recordReceivers(VkCommandBuffer cmd, bool clampParts) {
    for (std::size_t k = 0; k < m_buffers.blocks.size(); ++k) {
        const SparseBlock& block = m_buffers.blocks[k];
        const std::uint32_t count = block.end - block.begin;
        dispatch(cmd, m_receivers, m_sets[k],
                 {.begin = block.begin, .end = block.end, .clampParts = clampParts ? 1U : 0U},
                 m_bake.compressed.empty() ? groupsOf(count, kGatherLanes) : count);
    }
}

void SparseSteps::recordField(VkCommandBuffer cmd, const GpuField& field, float scale) {
    beginFieldWrite(cmd, field);
    const auto receivers = std::uint32_t(m_bake.receivers.size());
    const std::uint32_t cells = field.gridSize.x * field.gridSize.y * field.gridSize.z;
    dispatch(cmd, m_lightmap, m_sets[0], {.end = receivers, .fieldScale = scale},
             groupsOf(receivers, kLanes));
    dispatch(cmd, m_grid, m_sets[0],
             {.end = cells, .coefficients = field.bands * field.bands, .fieldScale = scale},
             groupsOf(cells, kLanes));
    endFieldWrite(cmd, field);
}

} // namespace limn
