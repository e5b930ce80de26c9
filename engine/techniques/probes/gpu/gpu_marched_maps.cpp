// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/gpu/gpu_marched_maps.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/storage_maker.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace limn {

static gpu::Buffer mapBuffer(gpu::Device& device, VkDeviceSize bytes, const char* name) {
    return {device,
            {.size = bytes,
             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                      VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
             .name = name}};
}

std::shared_ptr<GpuMarchedMaps> createMarchedMaps(gpu::Device& device, std::uint32_t probes,
                                                  std::uint32_t side) {
    const VkDeviceSize blocks = (side + MarchedMaps::kBlock - 1) / MarchedMaps::kBlock;
    const VkDeviceSize planes = VkDeviceSize(probes) * side * side * sizeof(glm::vec4);
    const VkDeviceSize nearest = probes * (blocks * blocks + 1) * sizeof(float);
    VkDeviceSize radiance = 0;
    for (VkDeviceSize s = side;; s = (s + 1) / 2) {
        radiance += probes * s * s * sizeof(glm::vec3);
        if (s <= MARCH_COARSEST)
            break;
    }
    if (std::max({planes, nearest, radiance}) > device.properties.limits.maxStorageBufferRange)
        return nullptr;
    auto maps = std::make_shared<GpuMarchedMaps>();
    maps->probes = probes;
    maps->side = side;
    maps->planes = mapBuffer(device, planes, "planes of probes");
    maps->nearest = mapBuffer(device, nearest, "nearest surfaces of probes");
    maps->radiance = mapBuffer(device, radiance, "radiance of probes");
    gpu::clearBuffers(device, {maps->planes.handle, maps->nearest.handle, maps->radiance.handle});
    return maps;
}

void uploadMarchedPlanes(gpu::Device& device, const MarchedMaps& maps,
                         std::span<const std::uint32_t> probes, const GpuMarchedMaps& to) {
    assert(maps.probes() == to.probes && maps.side == to.side);
    if (probes.empty())
        return;
    const std::size_t texels = maps.texels(), blocks = maps.nearestSide() * maps.nearestSide();
    const std::size_t row = (1 + blocks) * sizeof(float);
    std::vector<float> nearest(1 + blocks);
    const VkCommandBuffer cmd = device.begin("planes of probes");
    gpu::memoryBarrier(cmd, gpu::kAllReads, gpu::kTransferWrite);
    for (const std::uint32_t p : probes) {
        gpu::updateBuffer(device, cmd, to.planes, p * texels * sizeof(glm::vec4),
                          std::as_bytes(std::span(maps.planes).subspan(p * texels, texels)));
        nearest[0] = maps.inSolid[p] != 0 ? 1.f : 0.f;
        std::copy_n(maps.nearest.begin() + std::ptrdiff_t(p * blocks), blocks, nearest.begin() + 1);
        gpu::updateBuffer(device, cmd, to.nearest, p * row, std::as_bytes(std::span(nearest)));
    }
    device.submit(cmd);
}

void uploadMarchedRadiance(gpu::Device& device, const MarchedMaps& maps, const GpuMarchedMaps& to) {
    assert(maps.probes() == to.probes && maps.side == to.side);
    const VkCommandBuffer cmd = device.begin("radiance of probes");
    gpu::memoryBarrier(cmd, gpu::kAllReads, gpu::kTransferWrite);
    VkDeviceSize offset = 0;
    for (const std::vector<glm::vec3>& level : maps.radiance) {
        gpu::updateBuffer(device, cmd, to.radiance, offset, std::as_bytes(std::span(level)));
        offset += level.size() * sizeof(glm::vec3);
    }
    device.submit(cmd);
}

} // namespace limn
