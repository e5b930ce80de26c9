// SPDX-License-Identifier: MIT
#include "engine/render/passes/glass_pass.h"

#include "engine/render/passes/fullscreen.h"
#include "engine/render/passes/geometry_passes.h"
#include "shaders/viewport/glass.frag.h"

#include <array>

namespace limn::render {

GlassPass::GlassPass(gpu::Device& device, VkDescriptorSetLayout frameLayout) : m_behind(device) {
    const std::array layouts = {frameLayout, m_behind.layout()};
    m_layout = gpu::createPipelineLayout(device, layouts, 0, "glass");
    auto desc = fullscreenDesc(kGlassFrag, m_layout.handle, kLinearFormat, "glass");
    desc.blend = gpu::Blend::Add;
    m_pipeline = gpu::createGraphicsPipeline(device, desc);
}

void GlassPass::record(VkCommandBuffer cmd, VkDescriptorSet frameSet, const gpu::Image& behind,
                       std::uint32_t slot) {
    const std::array sets = {frameSet, m_behind.with(behind.view, slot)};
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_layout.handle, 0, sets.size(),
                            sets.data(), 0, nullptr);
    drawFullscreen(cmd, m_pipeline.handle);
}

} // namespace limn::render
