// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/techniques/sparse_probes/gpu/sparse_buffers.h"

#include <vector>

namespace limn {

/// The steps of sparse probes as compute shaders over one set of buffers. Each function records one
/// step and a barrier that makes what it wrote visible to the next.
class SparseSteps {
public:
    /// Number of invocations of a group where each handles its own receiver, or cell, and of a
    /// probe's group. There is one for each coefficient at least.
    static constexpr std::uint32_t kLanes = 64;
    /// The same where they share the probes' light.
    static constexpr std::uint32_t kGatherLanes = 128;
    /// Number of storage buffers bound at once.
    static constexpr std::uint32_t kStorageBuffers = SPARSE_LIGHTMAP;

    /// `device`, `bake` and `buffers` must outlive the object.
    SparseSteps(gpu::Device& device, const SparseBake& bake, const SparseBuffers& buffers);

    /// The field that recordField() writes. No earlier recording may still be running.
    void setField(const GpuField& field);

    /// Computes the radiance of the receivers; change[group] = its (change, total, relative change,
    /// brightest).
    void recordRadiosity(VkCommandBuffer cmd);
    void recordProbes(VkCommandBuffer cmd);
    /// `clampParts`: as gatherReceivers().
    void recordReceivers(VkCommandBuffer cmd, bool clampParts);
    /// Writes lightmap and grid, with values times `scale`, for fragment shaders.
    void recordField(VkCommandBuffer cmd, const GpuField& field, float scale);

    std::uint64_t dispatches = 0; ///< recorded so far

private:
    void createSets();
    gpu::Pipeline pipeline(gpu::Spirv shader, std::uint32_t lanes, const char* name);
    void dispatch(VkCommandBuffer cmd, const gpu::Pipeline& step, VkDescriptorSet set,
                  const shared::GpuSparseRange& range, std::size_t groups);

    gpu::Device& m_device;
    const SparseBake& m_bake;
    const SparseBuffers& m_buffers;
    std::uint32_t m_cached; ///< values of probes in shared memory; 1: none
    gpu::DescriptorSetLayout m_setLayout;
    gpu::DescriptorPool m_pool;
    std::vector<VkDescriptorSet> m_sets; ///< per block; one at least
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_radiosity, m_probes, m_receivers, m_lightmap, m_grid;
};

} // namespace limn
