// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/techniques/illuminance/gpu/relight_buffers.h"
#include "engine/techniques/illuminance/relight/caches/cache_light.h"
#include "shaders/shared/gpu_relight.h"

namespace limn {

/// A range of RelightBuffers::order.
struct CacheList {
    std::uint32_t begin = 0, end = 0;
};

/// The steps of relighting as compute shaders over one set of buffers. Each function records one
/// step and a barrier that makes what it wrote visible to the next.
class RelightSteps {
public:
    /// Number of invocations of a group where each handles its own item.
    static constexpr std::uint32_t kItemLanes = 64;
    /// Number of storage buffers bound at once: those of gpu_relight.h.
    static constexpr std::uint32_t kStorageBuffers = RELIGHT_LIGHTMAP;

    /// `device`, `bake` and `buffers` must outlive the object. The caches are lit in `bounce` bands
    /// and, in the end, in `final` bands.
    RelightSteps(gpu::Device& device, const Bake& bake, const RelightBuffers& buffers,
                 LightBands bounce, LightBands final);

    /// Computes B = albedo (E_direct + E_indirect) + pi L_e. Its changes in each group of surfels
    /// are those of bounce `k` in RelightBuffers::change.
    void recordSurfels(VkCommandBuffer cmd, std::uint32_t k);
    void recordPull(VkCommandBuffer cmd);
    /// Lights a list of the lightmap's caches in the bands of bounces, then fills all invalid ones.
    void recordLightmapCaches(VkCommandBuffer cmd, CacheList list);
    /// Computes E_indirect of the surfels from their caches.
    void recordIndirect(VkCommandBuffer cmd);
    /// Produces the final bands: the list's caches lose the chrominance that only bounces need, and
    /// the grid's caches are lit if `grid` is true.
    void recordFinalCaches(VkCommandBuffer cmd, CacheList list, bool grid);
    /// Writes lightmap and grid, with values times `scale`, for fragment shaders.
    void recordField(VkCommandBuffer cmd, CacheList list, bool grid, float scale);
    bool dropsChroma() const { return m_dropsChroma; }

    std::uint64_t dispatches = 0; ///< recorded so far

private:
    gpu::Pipeline pipeline(gpu::Spirv shader, std::uint32_t lanes, LightBands bands,
                           const char* name);
    void createSets();
    void dispatch(VkCommandBuffer cmd, const gpu::Pipeline& step,
                  const shared::GpuRelightRange& range, std::size_t groups);
    CacheList gridList() const;
    void lightCaches(VkCommandBuffer cmd, const gpu::Pipeline& step, CacheList list);
    void writeField(VkCommandBuffer cmd, CacheList list, float scale);
    void fill(VkCommandBuffer cmd, std::uint32_t begin, std::uint32_t end);

    gpu::Device& m_device;
    const Bake& m_bake;
    const RelightBuffers& m_buffers;
    std::uint32_t m_coefficients, m_layers;
    bool m_dropsChroma;
    gpu::DescriptorSetLayout m_setLayout;
    gpu::DescriptorPool m_pool;
    VkDescriptorSet m_set = VK_NULL_HANDLE;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_surfels, m_pull, m_bounceCaches, m_finalCaches, m_fill, m_indirect, m_chroma,
        m_field;
};

} // namespace limn
