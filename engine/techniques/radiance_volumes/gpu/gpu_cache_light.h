// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/techniques/radiance_volumes/allocation.h"
#include "engine/techniques/radiance_volumes/cache_light.h"
#include "engine/techniques/radiance_volumes/gpu/gpu_area_lights.h"
#include "engine/techniques/radiance_volumes/voxels.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace limn {

/// A light's area lights on a device, with its colour.
struct GpuLitAreaLights {
    const GpuAreaLights* lights;
    glm::vec3 colour; ///< times strength
};

/// What caches are lit from, as CacheLightInput.
struct GpuCacheLightInput {
    std::span<const GpuLitAreaLights> lights;
    ConeShadows shadows = ConeShadows::None;
    std::uint32_t bands = 2; ///< 2 or 3
    std::optional<GlossyMapShape> glossy;
    glm::vec3 eye{0};
};

/// CacheLight on a device. Empty buffers: there are no caches, or no maps.
struct GpuCachesLight {
    gpu::Buffer harmonics, glossy;
};

/// Lights caches as lightCaches() does. Repeats have the same bits. Not thread-safe.
class GpuCacheLight {
public:
    explicit GpuCacheLight(gpu::Device& device); ///< outlives the object

    /// Uploads the voxels. False if the device cannot bind them; there are none then.
    bool setVoxels(const VoxelVolume& voxels);

    /// The light of caches at these places. Maps are missing where the device cannot bind them, or
    /// what making them takes. Waits for the device.
    GpuCachesLight light(std::span<const CachePlace> places, GpuCacheLightInput input);

    std::uint64_t dispatches() const { return m_dispatches; } ///< so far
    std::uint64_t bytes() const { return m_voxels.size + m_visibility.size; }

private:
    struct Bound;
    void makeRoom(std::size_t caches, GpuCacheLightInput& input, GpuCachesLight& made);
    void recordLight(VkCommandBuffer cmd, const Bound& bound, const GpuCacheLightInput& input,
                     const GpuLitAreaLights& lit, bool first);
    void recordMaps(VkCommandBuffer cmd, const Bound& bound, const GpuCacheLightInput& input,
                    const GpuLitAreaLights* lit, bool first);

    gpu::Device& m_device;
    gpu::Buffer m_voxels;     ///< empty: none
    gpu::Buffer m_visibility; ///< of the blocks of one light from all caches, where there are maps
    Lattice m_lattice;
    gpu::DescriptorSetLayout m_setLayout;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_caches[2]; ///< of two and three bands
    gpu::Pipeline m_maps, m_fill;
    std::uint64_t m_dispatches = 0;
};

} // namespace limn
