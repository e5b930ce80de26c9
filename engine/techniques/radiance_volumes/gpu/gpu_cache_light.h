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
#include <span>
#include <vector>

namespace limn {

/// A light's area lights on a device, with its colour.
struct GpuLitAreaLights {
    const GpuAreaLights* lights;
    glm::vec3 colour; ///< times strength
};

/// Lights caches as lightCaches() does, without maps for reflections. Repeats have the same bits.
/// Not thread-safe.
class GpuCacheLight {
public:
    explicit GpuCacheLight(gpu::Device& device); ///< outlives the object

    /// Uploads the voxels. False if the device cannot bind them; there are none then.
    bool setVoxels(const VoxelVolume& voxels);

    /// The light of caches at these places: coefficients as CacheLight::harmonics. Empty without
    /// caches. Waits for the device.
    gpu::Buffer light(std::span<const CachePlace> places, std::span<const GpuLitAreaLights> lights,
                      ConeShadows shadows, std::uint32_t bands);

    std::uint64_t dispatches() const { return m_dispatches; } ///< so far
    std::uint64_t bytes() const { return m_voxels.size; }

private:
    gpu::Device& m_device;
    gpu::Buffer m_voxels; ///< empty: none
    Lattice m_lattice;
    gpu::DescriptorSetLayout m_setLayout;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_caches[2]; ///< of two and three bands
    std::uint64_t m_dispatches = 0;
};

} // namespace limn
