// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/render/viewport.h"
#include "engine/techniques/radiance_volumes/area_lights.h"
#include "shaders/shared/gpu_volumes.h"

#include <cstdint>

namespace limn {

/// AreaLights on a device. Those that reflect nothing are kept, so that each block has as many.
struct GpuAreaLights {
    Light shape;                                 ///< unitLight()
    gpu::Buffer lights;                          ///< array of shared::GpuAreaLight; empty: none
    gpu::Buffer blocks;                          ///< array of shared::GpuLightBlock
    std::uint32_t blockCount = 0, blockSize = 0; ///< blocks, and area lights of each
    bool parallel = false;                       ///< AreaLightBlock::parallel of all
    std::uint32_t views = 0;                     ///< of its map, that were drawn
};

/// Area lights of reflective shadow maps that a viewport draws, as areaLightsOf() makes them, but
/// for rounding and for the edges of triangles. Not thread-safe.
class GpuAreaLightMaps {
public:
    /// Both outlive the object.
    GpuAreaLightMaps(gpu::Device& device, Viewport& viewport);

    /// The area lights of a light, as unitLight() makes it, in the scene that the viewport shows.
    /// `bounds`: of the scene. Waits for the device.
    GpuAreaLights cast(const Light& light, const Bounds& bounds, const AreaLightOptions& options);

    std::uint64_t dispatches() const { return m_dispatches; } ///< so far
    std::uint64_t bytes() const { return m_mapBytes; }        ///< of the maps' images

private:
    void record(VkCommandBuffer cmd, const gpu::Pipeline& step,
                const shared::GpuVolumeMap& constants, std::uint32_t side);

    gpu::Device& m_device;
    Viewport& m_viewport;
    gpu::DescriptorSetLayout m_setLayout;
    gpu::DescriptorPool m_pool;
    VkDescriptorSet m_set = VK_NULL_HANDLE;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_map, m_blocks;
    std::uint64_t m_dispatches = 0, m_mapBytes = 0;
};

} // namespace limn
