// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/occlusion/link_occlusion.h"

#include <cstdint>
#include <optional>

namespace limn {

/// Rewrites the links of a bake on the GPU whose occlusion by dynamic objects has changed. The CPU
/// finds them, as for Relighter, and sends only the changed words to the GPU.
class GpuLinkOcclusion {
public:
    /// `links` are the bake's RelightBuffers::links. All three arguments must outlive the object.
    GpuLinkOcclusion(gpu::Device& device, const Bake& bake, const gpu::Buffer& links);

    /// Updates the links for the dynamic objects of `scene`; null: there are none. No submitted
    /// work may be reading the links; later submissions see the changes. Returns the bytes sent, 0
    /// where no link changed, or std::nullopt where no object has moved.
    std::optional<std::uint64_t> update(const Scene* scene);

    const HiddenLinks& hidden() const { return m_occlusion.hidden; }

private:
    void makePipeline();
    void fill(std::size_t begin, std::size_t end);

    gpu::Device& m_device;
    const Bake& m_bake;
    const gpu::Buffer& m_links;
    std::size_t m_words; ///< that change in a link: its cone's last one, or its harmonics
    LinkOcclusion m_occlusion;
    gpu::Buffer m_staging; ///< mapped; created when something is first occluded, then kept
    gpu::DescriptorSetLayout m_setLayout;
    gpu::DescriptorPool m_pool;
    VkDescriptorSet m_set = VK_NULL_HANDLE;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_pipeline;
};

} // namespace limn
