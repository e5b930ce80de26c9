// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/image.h"
#include "engine/gpu/pipeline.h"
#include "engine/render/surfaces/slot_texture.h"
#include "engine/scene/sky.h"

namespace limn::render {

/// The sky where no surface is seen. An image is kept as RGB9E5: within 1/512 of its brightest
/// component, at most 65408 nits.
class SkyPass {
public:
    SkyPass(gpu::Device& device, VkDescriptorSetLayout frameLayout);

    /// Uploads the image if it is another than before.
    void set(const Sky& sky);

    /// False while clearing to colour() shows all of the sky.
    bool active() const;
    glm::vec3 colour() const { return m_sky.radiance; } ///< [nits]

    /// Into the bound linear image; `frameSet` holds the depth image; `slot` as in MaterialSet.
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
