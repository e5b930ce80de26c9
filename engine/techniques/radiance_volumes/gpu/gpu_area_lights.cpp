// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/gpu/gpu_area_lights.h"

#include "engine/gpu/barrier.h"
#include "engine/rsm/gpu/rsm_maps.h"
#include "shaders/radiance_volumes/volume_blocks.comp.h"
#include "shaders/radiance_volumes/volume_map.comp.h"

#include <algorithm>
#include <array>
#include <vector>

namespace limn {

using shared::GpuVolumeMap;

namespace {

constexpr std::array kMapTypes = {kRsmTypes[0], kRsmTypes[1], kRsmTypes[2],
                                  VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                  VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
static_assert(kMapTypes.size() == VOLUME_MAP_BINDINGS);

} // namespace

GpuAreaLightMaps::GpuAreaLightMaps(gpu::Device& device, Viewport& viewport)
    : m_device(device), m_viewport(viewport), m_setLayout(gpu::createSetLayout(device, kMapTypes)),
      m_pool(gpu::createDescriptorPool(device, 1, kMapTypes)),
      m_set(gpu::allocateSet(device, m_pool, m_setLayout)),
      m_layout(gpu::createPipelineLayout(device, std::array{m_setLayout.handle},
                                         sizeof(GpuVolumeMap), "area lights")),
      m_map(gpu::createComputePipeline(device, kVolumeMapComp, m_layout.handle, {}, "area lights")),
      m_blocks(gpu::createComputePipeline(device, kVolumeBlocksComp, m_layout.handle, {},
                                          "blocks of area lights")) {}

void GpuAreaLightMaps::record(VkCommandBuffer cmd, const gpu::Pipeline& step,
                              const GpuVolumeMap& constants, std::uint32_t side) {
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, step.handle);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, m_layout.handle, 0, 1, &m_set, 0,
                            nullptr);
    vkCmdPushConstants(cmd, m_layout.handle, VK_SHADER_STAGE_ALL, 0, sizeof constants, &constants);
    const std::uint32_t groups = gpu::groups(side, VOLUME_MAP_LANES);
    vkCmdDispatch(cmd, groups, groups, 1);
    gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads);
    ++m_dispatches;
}

GpuAreaLights GpuAreaLightMaps::cast(const Light& light, const Bounds& bounds,
                                     const AreaLightOptions& options) {
    GpuAreaLights made{.shape = light};
    const std::vector<DrawnRsmView> views = drawnRsmViews(light, bounds, options.map);
    if (views.empty())
        return made;
    // Those into which nothing is sent count, too, so that the level is that of the CPU.
    const std::size_t all =
        rsmViews(light, bounds, options.map, [](glm::vec3 p, glm::vec3) { return p; }).size();
    const std::uint32_t side = sideRead(options.read, all, views[0].view.size);
    const std::uint32_t blockSide = std::max(side >> options.level, 1U);
    std::vector<SurfaceMapView> drawn;
    std::vector<GpuVolumeMap> constants;
    for (std::uint32_t k = 0; k < views.size(); ++k) {
        drawn.push_back(views[k].drawn);
        constants.push_back({.view = views[k].shaders,
                             .side = side,
                             .blockSide = blockSide,
                             .firstLight = k * side * side,
                             .firstBlock = k * blockSide * blockSide});
    }
    made.views = std::uint32_t(views.size());
    made.parallel = views[0].view.parallel;
    made.blockCount = made.views * blockSide * blockSide;
    made.blockSize = side / blockSide * (side / blockSide);
    const auto buffer = [&](std::size_t bytes, const char* name) {
        return gpu::Buffer(
            m_device, {.size = bytes, .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, .name = name});
    };
    made.lights =
        buffer(sizeof(shared::GpuAreaLight) * made.blockCount * made.blockSize, "area lights");
    made.blocks = buffer(sizeof(shared::GpuLightBlock) * made.blockCount, "blocks of area lights");
    m_viewport.drawSurfaceMaps(
        drawn, glm::uvec2(views[0].view.size),
        [&](VkCommandBuffer cmd, const SurfaceMap& map, std::size_t k) {
            if (k == 0) {
                writeRsmImages(m_device, m_set, map);
                gpu::writeBuffer(m_device, m_set, VOLUME_MAP_LIGHTS,
                                 VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, made.lights.handle);
                gpu::writeBuffer(m_device, m_set, VOLUME_MAP_BLOCKS,
                                 VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, made.blocks.handle);
                m_mapBytes = map.bytes;
            }
            record(cmd, m_map, constants[k], side);
            record(cmd, m_blocks, constants[k], blockSide);
        });
    return made;
}

} // namespace limn
