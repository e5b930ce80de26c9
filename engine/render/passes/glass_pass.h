// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/image.h"
#include "engine/gpu/pipeline.h"
#include "engine/render/surfaces/slot_texture.h"

#include <cstdint>

namespace limn::render {

/// Adds what is seen through transmissive surfaces to the linear picture of a view: the picture of
/// the surfaces that transmit nothing (GeometryView::throughGlass).
class GlassPass {
public:
    GlassPass(gpu::Device& device, VkDescriptorSetLayout frameLayout);

    /// Records the pass into the bound linear image. `frameSet` holds the surface images of all
    /// surfaces, and `behind`, which is in SHADER_READ_ONLY_OPTIMAL, the picture without glass;
    /// `slot` is that of MaterialSet.
    void record(VkCommandBuffer cmd, VkDescriptorSet frameSet, const gpu::Image& behind,
                std::uint32_t slot);

private:
    SlotTexture m_behind;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_pipeline;
};

} // namespace limn::render
