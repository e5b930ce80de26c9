// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/render/viewport.h"
#include "engine/techniques/radiance_volumes/allocation.h"
#include "shaders/shared/gpu_volumes.h"

#include <cstdint>
#include <optional>

namespace limn {

/// Places caches by a picture that a viewport draws, as allocateForView() does by rays. Not
/// thread-safe.
class GpuAllocation {
public:
    /// Both outlive the object.
    GpuAllocation(gpu::Device& device, Viewport& viewport);

    /// Waits for the device. Of the pixels, those that find no cache are counted; the points shown
    /// are those of all surfaces. None if the device cannot bind what the nodes take.
    std::optional<CacheAllocation> allocate(const Scene& scene, const Viewpoint& view,
                                            const VolumeSettings& settings);

    std::uint64_t dispatches() const { return m_dispatches; }
    std::uint64_t bytes() const { return m_sums.size; } ///< of the nodes' sums

private:
    struct Picture;
    void draw(const Picture& picture, const gpu::Pipeline& step, const gpu::Buffer& nodes);
    std::size_t countMissed(const Picture& picture, const CacheAllocation& made);

    gpu::Device& m_device;
    Viewport& m_viewport;
    gpu::Buffer m_grids;  ///< mapped
    gpu::Buffer m_sums;   ///< shared::GpuPlaceSums of each node
    gpu::Buffer m_missed; ///< mapped: a number
    gpu::DescriptorSetLayout m_setLayout;
    gpu::DescriptorPool m_pool;
    VkDescriptorSet m_set = VK_NULL_HANDLE;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_demand, m_count;
    std::uint64_t m_dispatches = 0;
};

} // namespace limn
