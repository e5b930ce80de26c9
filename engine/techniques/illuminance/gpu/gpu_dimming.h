// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/techniques/illuminance/bake/bake.h"
#include "engine/techniques/illuminance/relight/occlusion/dimming.h"

#include <cstdint>
#include <optional>

namespace limn {

/// Rewrites those links of a bake on the GPU that dynamic objects hide otherwise than before. The
/// CPU finds them, as for Relighter; what goes to the GPU is the changed words.
class GpuDimming {
public:
    /// `bake` and `links`, its RelightBuffers::links, outlive this.
    GpuDimming(gpu::Device& device, const Bake& bake, const gpu::Buffer& links);

    /// Follows the dynamic objects of `scene`; null: there are none. Nothing submitted reads the
    /// links; those that change are there for later submissions. Returns the bytes sent, which are
    /// 0 where no link changed; nothing where no object had moved.
    std::optional<std::uint64_t> update(const Scene* scene);

    const HiddenLinks& hidden() const { return m_dimming.hidden; }

private:
    void makePipeline();
    void fill(std::size_t begin, std::size_t end);

    gpu::Device& m_device;
    const Bake& m_bake;
    const gpu::Buffer& m_links;
    std::size_t m_words; ///< of a link that change: its cone's last one, or its harmonics
    Dimming m_dimming;
    gpu::Buffer m_staging; ///< mapped; empty until something is dimmed, and never made anew
    gpu::DescriptorSetLayout m_setLayout;
    gpu::DescriptorPool m_pool;
    VkDescriptorSet m_set = VK_NULL_HANDLE;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_pipeline;
};

} // namespace limn
