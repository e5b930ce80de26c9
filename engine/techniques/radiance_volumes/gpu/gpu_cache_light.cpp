// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/gpu/gpu_cache_light.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/uploader.h"
#include "shaders/radiance_volumes/volume_caches.comp.h"

#include <algorithm>
#include <array>

namespace limn {

using shared::GpuVolumeLight;

namespace {

constexpr std::array kCacheTypes = {
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
static_assert(kCacheTypes.size() == VOLUME_CACHE_BINDINGS);
static_assert(VOLUME_SHADOWS_DIRECTIONAL == std::uint32_t(ConeShadows::Directional) &&
              VOLUME_SHADOWS_PUBLISHED == std::uint32_t(ConeShadows::Published));

/// All levels of a volume, a word for each cell: bytes of what light along x, y and z meets, and,
/// of the finest level, the distance, of others the mean.
std::vector<std::uint32_t> wordsOf(const VoxelVolume& voxels) {
    std::vector<std::uint32_t> words;
    for (std::size_t c = 0; c < voxels.distance.size(); ++c)
        words.push_back(std::uint32_t(voxels.distance[c]) << 24);
    for (std::size_t k = 0; k < voxels.mean.size(); ++k)
        for (std::size_t c = 0; c < voxels.mean[k].size(); ++c)
            words.push_back(std::uint32_t(voxels.along[0][k][c]) |
                            std::uint32_t(voxels.along[1][k][c]) << 8 |
                            std::uint32_t(voxels.along[2][k][c]) << 16 |
                            std::uint32_t(voxels.mean[k][c]) << 24);
    return words;
}

} // namespace

GpuCacheLight::GpuCacheLight(gpu::Device& device)
    : m_device(device), m_setLayout(gpu::createSetLayout(device, kCacheTypes)),
      m_layout(gpu::createPipelineLayout(device, std::array{m_setLayout.handle},
                                         sizeof(GpuVolumeLight), "light of caches")) {
    for (std::uint32_t k = 0; k < 2; ++k)
        m_caches[k] = gpu::createComputePipeline(
            device, kVolumeCachesComp, m_layout.handle,
            std::array<std::uint32_t, 2>{VOLUME_CACHE_LANES, 2 + k}, "light of caches");
}

bool GpuCacheLight::setVoxels(const VoxelVolume& voxels) {
    m_voxels = {};
    const std::vector<std::uint32_t> words = wordsOf(voxels);
    const auto bytes = std::as_bytes(std::span(words));
    if (bytes.size() > m_device.properties.limits.maxStorageBufferRange)
        return false;
    m_voxels = gpu::Uploader(m_device).buffer(bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "voxels");
    m_lattice = voxels.lattice;
    return true;
}

gpu::Buffer GpuCacheLight::light(std::span<const CachePlace> places,
                                 std::span<const GpuLitAreaLights> lights, ConeShadows shadows,
                                 std::uint32_t bands) {
    if (places.empty())
        return {};
    if (!m_voxels)
        shadows = ConeShadows::None;
    const float raise = coneRaise(shadows, m_lattice.cell);
    std::vector<shared::GpuCachePlace> onDevice;
    for (const CachePlace& place : places)
        onDevice.push_back({.position = place.position, .raised = place.raised(raise)});
    gpu::Uploader uploader(m_device);
    const gpu::Buffer placed = uploader.buffer(std::as_bytes(std::span(onDevice)),
                                               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "caches");
    uploader.flush();
    gpu::Buffer harmonics(m_device, {.size = places.size() * bands * bands * sizeof(glm::vec3),
                                     .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                              VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                              VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                     .name = "light of caches"});
    std::vector<const GpuLitAreaLights*> shining;
    for (const GpuLitAreaLights& lit : lights)
        if (lit.lights->blockCount > 0)
            shining.push_back(&lit);
    const gpu::DescriptorPool pool = gpu::createDescriptorPool(
        m_device, std::max<std::uint32_t>(std::uint32_t(shining.size()), 1U), kCacheTypes);
    m_device.immediate("light of caches", [&](VkCommandBuffer cmd) {
        if (shining.empty()) {
            vkCmdFillBuffer(cmd, harmonics.handle, 0, VK_WHOLE_SIZE, 0);
            gpu::memoryBarrier(cmd, gpu::kTransferWrite, gpu::kAllReads);
        }
        for (const GpuLitAreaLights* lit : shining) {
            const VkDescriptorSet set = gpu::allocateSet(m_device, pool, m_setLayout);
            const auto bind = [&](std::uint32_t binding, const gpu::Buffer& buffer) {
                gpu::writeBuffer(m_device, set, binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                 buffer.handle);
            };
            bind(VOLUME_CACHE_PLACES, placed);
            bind(VOLUME_CACHE_LIGHTS, lit->lights->lights);
            bind(VOLUME_CACHE_BLOCKS, lit->lights->blocks);
            bind(VOLUME_CACHE_VOXELS, m_voxels ? m_voxels : placed); // not read without shadows
            bind(VOLUME_CACHE_HARMONICS, harmonics);
            const GpuVolumeLight constants{.colour = lit->colour,
                                           .blocks = lit->lights->blockCount,
                                           .voxelLower = m_lattice.lower,
                                           .voxelCell = m_lattice.cell,
                                           .voxelSide = m_lattice.size.x,
                                           .shadows = std::uint32_t(shadows),
                                           .blockLights = lit->lights->blockSize,
                                           .parallel = lit->lights->parallel ? 1U : 0U,
                                           .raise = raise,
                                           .caches = std::uint32_t(places.size()),
                                           .first = lit == shining.front() ? 1U : 0U};
            m_dispatches +=
                gpu::dispatch(m_device, cmd, m_caches[bands - 2].handle, m_layout.handle, set,
                              std::as_bytes(std::span(&constants, 1)), places.size());
            gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads);
        }
    });
    return harmonics;
}

} // namespace limn
