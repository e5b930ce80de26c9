// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/pipeline.h"
#include "engine/render/surfaces/slot_texture.h"
#include "engine/scene/view.h"
#include "shaders/shared/gpu_tonemap.h"

namespace limn::render {

constexpr VkFormat kColorFormat = VK_FORMAT_R8G8B8A8_UNORM; ///< holds sRGB-encoded values

/// Converts the linear image to sRGB-encoded RGBA8.
class TonemapPass {
public:
    explicit TonemapPass(gpu::Device& device);

    /// Draws into the bound colour attachment. `linear` is in SHADER_READ_ONLY_OPTIMAL; `slot` is
    /// that of MaterialSet.
    void record(VkCommandBuffer cmd, VkImageView linear, const shared::GpuTonemap& push,
                std::uint32_t slot);

private:
    SlotTexture m_linear;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_pipeline;
};

} // namespace limn::render
