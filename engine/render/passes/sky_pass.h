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

    /// Binds the sky to a slot of MaterialSet. No frame in flight may use it.
    void bind(std::uint32_t slot) { m_texture.with(m_panorama.view, slot); }

    /// Records the pass into the bound linear image, for the slot that was bound. `frameSet` holds
    /// the depth image.
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
