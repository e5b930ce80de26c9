// SPDX-License-Identifier: MIT
#include "engine/render/direct_pass.h"

#include "engine/render/geometry_passes.h"
#include "shaders/direct.frag.h"
#include "shaders/fullscreen.vert.h"

#include <cassert>

namespace limn::render {

DirectPass::DirectPass(gpu::Device& device, VkDescriptorSetLayout frameLayout) : m_device(device) {
    m_layout = gpu::createPipelineLayout(device, {&frameLayout, 1}, 0, "direct light");
}

void DirectPass::record(VkCommandBuffer cmd, VkDescriptorSet frameSet, View view) {
    assert(showsDirectLight(view));
    gpu::Pipeline& pipeline = m_pipelines[view];
    if (!pipeline) {
        gpu::GraphicsPipelineDesc desc;
        desc.vertex = kFullscreenVert;
        desc.fragment = kDirectFrag;
        desc.layout = m_layout.handle;
        desc.colorFormats = {kLinearFormat};
        desc.additive = true;
        desc.constants = {std::uint32_t(view)};
        desc.name = "direct light";
        pipeline = gpu::createGraphicsPipeline(m_device, desc);
    }
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.handle);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_layout.handle, 0, 1, &frameSet,
                            0, nullptr);
    vkCmdDraw(cmd, 3, 1, 0, 0);
}

} // namespace limn::render
