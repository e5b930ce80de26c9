// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/gpu/gpu_cache_light.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/uploader.h"
#include "shaders/radiance_volumes/volume_caches.comp.h"
#include "shaders/radiance_volumes/volume_fill.comp.h"
#include "shaders/radiance_volumes/volume_maps.comp.h"

#include <algorithm>
#include <array>

namespace limn {

using shared::GpuVolumeLight;
using shared::GpuVolumeMaps;

namespace {

constexpr std::array<VkDescriptorType, VOLUME_CACHE_BINDINGS> kCacheTypes = {
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
static_assert(VOLUME_SHADOWS_DIRECTIONAL == std::uint32_t(ConeShadows::Directional) &&
              VOLUME_SHADOWS_PUBLISHED == std::uint32_t(ConeShadows::Published));

/// All levels of a volume, a word for each cell: bytes of what light along x, y and z meets, and of
/// the mean; of the finest level, the opacity and, in the highest byte, the distance.
std::vector<std::uint32_t> wordsOf(const VoxelVolume& voxels) {
    std::vector<std::uint32_t> words;
    for (std::size_t c = 0; c < voxels.distance.size(); ++c)
        words.push_back(std::uint32_t(voxels.distance[c]) << 24 | solidOpacity(voxels, c));
    for (const VoxelLevel& level : voxels.coarse)
        words.insert(words.end(), level.begin(), level.end());
    return words;
}

} // namespace

GpuCacheLight::GpuCacheLight(gpu::Device& device)
    : m_device(device), m_setLayout(gpu::createSetLayout(device, kCacheTypes)),
      m_layout(gpu::createPipelineLayout(device, std::array{m_setLayout.handle},
                                         std::max(sizeof(GpuVolumeLight), sizeof(GpuVolumeMaps)),
                                         "light of caches")) {
    for (std::uint32_t k = 0; k < 2; ++k)
        m_caches[k] = gpu::createComputePipeline(
            device, kVolumeCachesComp, m_layout.handle,
            std::array<std::uint32_t, 2>{VOLUME_CACHE_LANES, 2 + k}, "light of caches");
    m_maps = gpu::createComputePipeline(device, kVolumeMapsComp, m_layout.handle,
                                        std::array<std::uint32_t, 1>{VOLUME_CACHE_LANES},
                                        "maps of caches");
    m_fill = gpu::createComputePipeline(device, kVolumeFillComp, m_layout.handle,
                                        std::array<std::uint32_t, 1>{VOLUME_CACHE_LANES},
                                        "fill maps of caches");
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

/// What the steps of one light bind.
struct GpuCacheLight::Bound {
    VkDescriptorSet set;
    std::uint32_t caches;
    float raise;
};

/// Makes what the light is written to. Takes the maps out of the input where there is no room.
void GpuCacheLight::makeRoom(std::size_t caches, GpuCacheLightInput& input, GpuCachesLight& made) {
    const auto buffer = [&](std::size_t bytes, const char* name) {
        return gpu::Buffer(m_device, {.size = bytes,
                                      .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                               VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                               VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                      .name = name});
    };
    made.harmonics =
        buffer(caches * input.bands * input.bands * sizeof(glm::vec3), "light of caches");
    std::size_t blocks = 0;
    for (const GpuLitAreaLights& lit : input.lights)
        blocks = std::max<std::size_t>(blocks, lit.lights->blockCount);
    const std::size_t texels = input.glossy ? input.glossy->texels() * sizeof(glm::vec3) : 0;
    const std::uint64_t limit = m_device.properties.limits.maxStorageBufferRange;
    if (caches * std::max(texels, blocks * sizeof(float)) > limit)
        input.glossy.reset();
    m_visibility = {};
    if (!input.glossy || blocks == 0)
        return;
    made.glossy = buffer(caches * texels, "maps of caches");
    m_visibility = buffer(caches * blocks * sizeof(float), "visibility of blocks");
}

void GpuCacheLight::recordLight(VkCommandBuffer cmd, const Bound& bound,
                                const GpuCacheLightInput& input, const GpuLitAreaLights& lit,
                                bool first) {
    const GpuVolumeLight constants{.colour = lit.colour,
                                   .blocks = lit.lights->blockCount,
                                   .voxelLower = m_lattice.lower,
                                   .voxelCell = m_lattice.cell,
                                   .voxelSide = m_lattice.size.x,
                                   .shadows = std::uint32_t(input.shadows),
                                   .blockLights = lit.lights->blockSize,
                                   .parallel = lit.lights->parallel ? 1U : 0U,
                                   .raise = bound.raise,
                                   .caches = bound.caches,
                                   .first = first ? 1U : 0U,
                                   .keepsVisibility = m_visibility ? 1U : 0U};
    m_dispatches += gpu::dispatch(m_device, cmd, m_caches[input.bands - 2].handle, m_layout.handle,
                                  bound.set, std::as_bytes(std::span(&constants, 1)), bound.caches);
}

/// Adds a light to the maps; null: completes them.
void GpuCacheLight::recordMaps(VkCommandBuffer cmd, const Bound& bound,
                               const GpuCacheLightInput& input, const GpuLitAreaLights* lit,
                               bool first) {
    const GpuVolumeMaps constants{.eye = input.eye,
                                  .tile = input.glossy->tile,
                                  .colour = lit ? lit->colour : glm::vec3(0),
                                  .caches = bound.caches,
                                  .blocks = lit ? lit->lights->blockCount : 0,
                                  .blockLights = lit ? lit->lights->blockSize : 0,
                                  .fill = input.glossy->fill,
                                  .first = first ? 1U : 0U,
                                  .microfacet = input.glossy->microfacet ? 1U : 0U};
    const auto pushed = std::as_bytes(std::span(&constants, 1));
    m_dispatches += gpu::dispatch(m_device, cmd, m_maps.handle, m_layout.handle, bound.set, pushed,
                                  gpu::groups(bound.caches, VOLUME_CACHE_LANES));
    if (!lit && input.glossy->fill > 0)
        m_dispatches += gpu::dispatch(m_device, cmd, m_fill.handle, m_layout.handle, bound.set,
                                      pushed, bound.caches);
}

GpuCachesLight GpuCacheLight::light(std::span<const CachePlace> places, GpuCacheLightInput input) {
    GpuCachesLight made;
    if (places.empty())
        return made;
    if (!m_voxels)
        input.shadows = ConeShadows::None;
    std::vector<const GpuLitAreaLights*> shining;
    for (const GpuLitAreaLights& lit : input.lights)
        if (lit.lights->blockCount > 0)
            shining.push_back(&lit);
    makeRoom(places.size(), input, made);
    Bound bound{.set = VK_NULL_HANDLE,
                .caches = std::uint32_t(places.size()),
                .raise = coneRaise(input.shadows, m_lattice.cell)};
    std::vector<shared::GpuCachePlace> onDevice;
    for (const CachePlace& place : places)
        onDevice.push_back({.position = place.position,
                            .raised = coneStart(place, input.shadows, m_lattice.cell)});
    gpu::Uploader uploader(m_device);
    const gpu::Buffer placed = uploader.buffer(std::as_bytes(std::span(onDevice)),
                                               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "caches");
    uploader.flush();
    const gpu::DescriptorPool pool = gpu::createDescriptorPool(
        m_device, std::max(std::uint32_t(shining.size()), 1U), kCacheTypes);
    m_device.immediate("light of caches", [&](VkCommandBuffer cmd) {
        if (shining.empty()) {
            vkCmdFillBuffer(cmd, made.harmonics.handle, 0, VK_WHOLE_SIZE, 0);
            gpu::memoryBarrier(cmd, gpu::kTransferWrite, gpu::kAllReads);
        }
        for (const GpuLitAreaLights* lit : shining) {
            const bool first = lit == shining.front();
            bound.set = gpu::allocateSet(m_device, pool, m_setLayout);
            const auto bind = [&](std::uint32_t binding, const gpu::Buffer& buffer) {
                // What is empty is not read.
                gpu::writeBuffer(m_device, bound.set, binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                 buffer ? buffer.handle : placed.handle);
            };
            bind(VOLUME_CACHE_PLACES, placed);
            bind(VOLUME_CACHE_LIGHTS, lit->lights->lights);
            bind(VOLUME_CACHE_BLOCKS, lit->lights->blocks);
            bind(VOLUME_CACHE_VOXELS, m_voxels);
            bind(VOLUME_CACHE_HARMONICS, made.harmonics);
            bind(VOLUME_CACHE_VISIBILITY, m_visibility);
            bind(VOLUME_CACHE_GLOSSY, made.glossy);
            recordLight(cmd, bound, input, *lit, first);
            if (made.glossy)
                recordMaps(cmd, bound, input, lit, first);
        }
        if (made.glossy)
            recordMaps(cmd, bound, input, nullptr, false);
        gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads);
    });
    return made;
}

} // namespace limn
