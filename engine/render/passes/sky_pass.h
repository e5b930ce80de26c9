// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/image.h"
#include "engine/gpu/pipeline.h"
#include "engine/render/surfaces/slot_texture.h"
#include "engine/scene/sky.h"

namespace limn::render {

/// Draws the sky where no surface is seen. A sky image is stored as RGB9E5, accurate to 1/512 of
/// its brightest component and at most 65408 nits.
class SkyPass {
public:
    SkyPass(gpu::Device& device, VkDescriptorSetLayout frameLayout);

    /// Sets the sky and uploads its image if it changed.
    void set(const Sky& sky);

    /// False if clearing to colour() is enough to show the sky.
    bool active() const;
    glm::vec3 colour() const { return m_sky.radiance; } ///< [nits]

    /// Records the pass into the bound linear image. `frameSet` holds the depth image; `slot` is
    /// that of MaterialSet.
    void record(VkCommandBuffer cmd, VkDescriptorSet frameSet, std::uint32_t slot);

private:
    gpu::Device& m_device;
    SlotTexture m_texture;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_pipeline;
    Sky m_sky;
    std::shared_ptr<const SkyImage> m_uploaded; ///< what m_panorama holds; null: one black pixel
    gpu::Image m_panorama;
};

} // namespace limn::render
