// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/gpu/gpu_light_maps.h"

#include "engine/gpu/barrier.h"
#include "engine/lattice/cell_lobes.h"
#include "engine/rsm/gpu/rsm_maps.h"
#include "shaders/lpv/lpv_collect.comp.h"
#include "shaders/lpv/lpv_map.comp.h"
#include "shaders/shared/gpu_lpv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace limn {

using shared::GpuLpvMap;

namespace {

constexpr VkDescriptorType kBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
constexpr std::array kTypes = {kRsmTypes[0], kRsmTypes[1], kRsmTypes[2], kBuffer, kBuffer, kBuffer};
static_assert(kTypes.size() == LPV_MAP_BINDINGS);
constexpr float kPi = std::numbers::pi_v<float>;

/// Integers per unit of a lobe: a power of two by which not even all that a light can send, in one
/// cell, exceeds 2^30.
float integersPerUnit(const std::vector<DrawnRsmView>& views) {
    const RsmView& view = views[0].view;
    float largest = view.area() * float(views.size());
    if (!view.parallel)
        largest = std::min(largest, 4 * kPi * float((views.size() + 5) / 6));
    const float lobe = 1.1f * largest * view.power * kCosineSlope / kPi;
    return lobe > 0 ? std::exp2(std::floor(30 - std::log2(lobe))) : 0;
}

} // namespace

GpuLightMaps::GpuLightMaps(gpu::Device& device, Viewport& viewport)
    : m_device(device), m_viewport(viewport),
      m_count(device,
              {.size = sizeof(std::uint32_t),
               .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
               .memory = gpu::MemoryKind::Readback,
               .name = "lit cells"}),
      m_setLayout(gpu::createSetLayout(device, kTypes)),
      m_pool(gpu::createDescriptorPool(device, 1, kTypes)),
      m_set(gpu::allocateSet(device, m_pool, m_setLayout)),
      m_layout(gpu::createPipelineLayout(device, std::array{m_setLayout.handle}, sizeof(GpuLpvMap),
                                         "reflective shadow maps")) {
    const auto pipeline = [&](gpu::Spirv shader, std::uint32_t lists, const char* name) {
        return gpu::createComputePipeline(device, shader, m_layout.handle, std::array{lists}, name);
    };
    m_map = pipeline(kLpvMapComp, 0, "inject map");
    m_countCells = pipeline(kLpvCollectComp, 0, "count lit cells");
    m_listCells = pipeline(kLpvCollectComp, 1, "list lit cells");
}

void GpuLightMaps::makeRoom(const Lattice& lattice) {
    const VkDeviceSize bytes = lattice.cells() * 12 * sizeof(std::int32_t);
    if (m_sums.size == bytes)
        return;
    m_sums = {m_device,
              {.size = bytes,
               .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
               .name = "sums of a map"}};
    m_device.immediate("clear sums", [&](VkCommandBuffer cmd) {
        vkCmdFillBuffer(cmd, m_sums.handle, 0, VK_WHOLE_SIZE, 0);
        gpu::memoryBarrier(cmd, gpu::kTransferWrite, gpu::kComputeWrite);
    });
}

void GpuLightMaps::record(VkCommandBuffer cmd, const gpu::Pipeline& step,
                          const GpuLpvMap& constants) {
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, step.handle);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, m_layout.handle, 0, 1, &m_set, 0,
                            nullptr);
    vkCmdPushConstants(cmd, m_layout.handle, VK_SHADER_STAGE_ALL, 0, sizeof constants, &constants);
    ++m_dispatches;
}

void GpuLightMaps::recordMap(VkCommandBuffer cmd, const GpuLpvMap& constants) {
    record(cmd, m_map, constants);
    const std::uint32_t side = gpu::groups(constants.view.mapSize, LPV_MAP_LANES);
    vkCmdDispatch(cmd, side, side, 1);
    gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kComputeWrite);
}

void GpuLightMaps::recordCollect(VkCommandBuffer cmd, const gpu::Pipeline& step,
                                 const GpuLpvMap& constants) {
    gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kTransferWrite);
    vkCmdFillBuffer(cmd, m_count.handle, 0, VK_WHOLE_SIZE, 0);
    gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kComputeWrite);
    record(cmd, step, constants);
    const glm::uvec3 size = constants.size;
    vkCmdDispatch(cmd, gpu::groups(size.x, LPV_GROUP_X), gpu::groups(size.y, LPV_GROUP_Y),
                  gpu::groups(size.z, LPV_GROUP_Z));
    gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads);
    gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kHostRead);
}

MappedLight GpuLightMaps::cast(const Light& light, const Bounds& bounds, std::uint32_t size,
                               const Lattice& lattice) {
    const std::vector<DrawnRsmView> views = drawnRsmViews(light, bounds, size);
    MappedLight mapped{.views = std::uint32_t(views.size())};
    const float scale = views.empty() ? 0 : integersPerUnit(views);
    if (!(scale > 0) || !std::isfinite(scale))
        return mapped;
    makeRoom(lattice);
    std::vector<SurfaceMapView> drawn;
    std::vector<GpuLpvMap> constants;
    for (const DrawnRsmView& view : views) {
        drawn.push_back(view.drawn);
        constants.push_back({.view = view.shaders,
                             .lower = lattice.lower,
                             .cell = lattice.cell,
                             .size = lattice.size,
                             .scale = scale});
    }
    m_viewport.drawSurfaceMaps(
        drawn, glm::uvec2(views[0].view.size),
        [&](VkCommandBuffer cmd, const SurfaceMap& map, std::size_t k) {
            if (k == 0) {
                writeRsmImages(m_device, m_set, map);
                gpu::writeBuffer(m_device, m_set, LPV_MAP_SUMS, kBuffer, m_sums.handle);
                gpu::writeBuffer(m_device, m_set, LPV_MAP_COUNT, kBuffer, m_count.handle);
                // Counting does not write lobes.
                gpu::writeBuffer(m_device, m_set, LPV_MAP_LOBES, kBuffer, m_sums.handle);
                m_mapBytes = map.bytes;
            }
            recordMap(cmd, constants[k]);
            if (k + 1 == views.size())
                recordCollect(cmd, m_countCells, constants[k]);
        });
    mapped.count = *static_cast<const std::uint32_t*>(m_count.mapped);
    if (mapped.count == 0)
        return mapped;
    mapped.cells = {m_device,
                    {.size = mapped.count * sizeof(shared::GpuCellLobe),
                     .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                     .name = "injected lobes"}};
    gpu::writeBuffer(m_device, m_set, LPV_MAP_LOBES, kBuffer, mapped.cells.handle);
    m_device.immediate("list lit cells", [&](VkCommandBuffer cmd) {
        recordCollect(cmd, m_listCells, constants.back());
    });
    return mapped;
}

} // namespace limn
