// SPDX-License-Identifier: MIT
#include "engine/render/passes/mean_pass.h"

#include "engine/gpu/barrier.h"
#include "engine/render/passes/fullscreen.h"
#include "engine/render/passes/geometry_passes.h"
#include "shaders/viewport/mean.frag.h"

#include <array>

namespace limn::render {

MeanPass::MeanPass(gpu::Device& device) : m_picture(device) {
    const std::array layouts = {m_picture.layout()};
    m_layout = gpu::createPipelineLayout(device, layouts, sizeof(float), "mean");
    auto desc = fullscreenDesc(kMeanFrag, m_layout.handle, kLinearFormat, "mean");
    desc.blend = gpu::Blend::Mix;
    m_pipeline = gpu::createGraphicsPipeline(device, desc);
}

void MeanPass::record(VkCommandBuffer cmd, const gpu::Image& picture, const gpu::Image& mean,
                      std::uint32_t count, Extent size, std::uint32_t slot) {
    gpu::imageBarrier(cmd, mean.handle, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kFragmentRead,
                      gpu::kColorWrite);
    const std::array color = {attachment(mean.view, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                         VK_ATTACHMENT_LOAD_OP_LOAD)};
    beginRendering(cmd, size, color, nullptr, false);
    const VkDescriptorSet set = m_picture.with(picture.view, slot);
    const float weight = 1 / float(count + 1);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_layout.handle, 0, 1, &set, 0,
                            nullptr);
    vkCmdPushConstants(cmd, m_layout.handle, VK_SHADER_STAGE_ALL, 0, sizeof weight, &weight);
    drawFullscreen(cmd, m_pipeline.handle);
    vkCmdEndRendering(cmd);
    gpu::imageBarrier(cmd, mean.handle, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kColorWrite,
                      gpu::kFragmentRead);
}

} // namespace limn::render
