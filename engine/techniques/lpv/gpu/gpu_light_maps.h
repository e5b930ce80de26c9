// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/lattice/lattice.h"
#include "engine/render/viewport.h"
#include "shaders/shared/gpu_lpv_map.h"

#include <cstdint>

namespace limn {

/// What a light of colour 1 sends into the cells of a lattice.
struct MappedLight {
    gpu::Buffer cells; ///< array of shared::GpuCellLobe, each cell once; empty where there are none
    std::uint32_t count = 0;
    std::uint32_t views = 0; ///< of its map, that were drawn
};

/// Reflective shadow maps that a viewport draws, and their injection, as compute shaders. Texels
/// are those of castRsm(), but for rounding and for the edges of triangles; they are summed in
/// integers, in steps of about a billionth of all that the light can send, so that the result has
/// the same bits each time. Not thread-safe. Dachsbacher, Stamminger. Reflective Shadow Maps. 2005
class GpuLightMaps {
public:
    /// Both outlive the object. The device can bind three storage buffers at once.
    GpuLightMaps(gpu::Device& device, Viewport& viewport);

    /// Draws the map of a light, as unitLight() makes it, of the scene that the viewport shows, and
    /// sums what its texels reflect in cells. `bounds`: of the scene; `size`: as for castRsm().
    /// Waits for the device.
    MappedLight cast(const Light& light, const Bounds& bounds, std::uint32_t size,
                     const Lattice& lattice);

    std::uint64_t dispatches() const { return m_dispatches; }        ///< so far
    std::uint64_t bytes() const { return m_sums.size + m_mapBytes; } ///< of sums and images

private:
    void makeRoom(const Lattice& lattice);
    void record(VkCommandBuffer cmd, const gpu::Pipeline& step, const shared::GpuLpvMap& constants);
    void recordMap(VkCommandBuffer cmd, const shared::GpuLpvMap& constants);
    void recordCollect(VkCommandBuffer cmd, const gpu::Pipeline& step,
                       const shared::GpuLpvMap& constants);

    gpu::Device& m_device;
    Viewport& m_viewport;
    gpu::Buffer m_sums;  ///< 0 between two casts
    gpu::Buffer m_count; ///< mapped
    gpu::DescriptorSetLayout m_setLayout;
    gpu::DescriptorPool m_pool;
    VkDescriptorSet m_set = VK_NULL_HANDLE;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_map, m_countCells, m_listCells;
    std::uint64_t m_dispatches = 0, m_mapBytes = 0;
};

} // namespace limn
