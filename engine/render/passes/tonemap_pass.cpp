// SPDX-License-Identifier: MIT
#include "engine/render/passes/tonemap_pass.h"

#include "engine/render/passes/fullscreen.h"
#include "shaders/viewport/tonemap.frag.h"

namespace limn::render {

using shared::GpuTonemap;

static_assert(std::uint32_t(Tonemap::Aces) == TONEMAP_ACES &&
              std::uint32_t(Tonemap::Agx) == TONEMAP_AGX &&
              std::uint32_t(Tonemap::PbrNeutral) == TONEMAP_PBR_NEUTRAL);

TonemapPass::TonemapPass(gpu::Device& device) : m_linear(device) {
    const std::array layouts = {m_linear.layout()};
    m_layout = gpu::createPipelineLayout(device, layouts, sizeof(GpuTonemap), "tone mapping");
    m_pipeline = gpu::createGraphicsPipeline(
        device, fullscreenDesc(kTonemapFrag, m_layout.handle, kColorFormat, "tone mapping"));
}

void TonemapPass::record(VkCommandBuffer cmd, VkImageView linear, const GpuTonemap& push,
                         std::uint32_t slot) {
    const VkDescriptorSet set = m_linear.with(linear, slot);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_layout.handle, 0, 1, &set, 0,
                            nullptr);
    vkCmdPushConstants(cmd, m_layout.handle, VK_SHADER_STAGE_ALL, 0, sizeof push, &push);
    drawFullscreen(cmd, m_pipeline.handle);
}

} // namespace limn::render
