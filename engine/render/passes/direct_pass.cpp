// SPDX-License-Identifier: MIT
#include "engine/render/passes/direct_pass.h"

#include "engine/render/passes/fullscreen.h"
#include "engine/render/passes/geometry_passes.h"
#include "shaders/viewport/direct.frag.h"

#include <cassert>

namespace limn::render {

DirectPass::DirectPass(gpu::Device& device, VkDescriptorSetLayout frameLayout) : m_device(device) {
    m_layout = gpu::createPipelineLayout(device, {&frameLayout, 1}, 0, "direct light");
}

void DirectPass::record(VkCommandBuffer cmd, VkDescriptorSet frameSet, View view) {
    assert(showsDirectLight(view));
    gpu::Pipeline& pipeline = m_pipelines[view];
    if (!pipeline) {
        auto desc = fullscreenDesc(kDirectFrag, m_layout.handle, kLinearFormat, "direct light");
        desc.blend = gpu::Blend::Add;
        desc.constants = {std::uint32_t(view)};
        pipeline = gpu::createGraphicsPipeline(m_device, desc);
    }
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_layout.handle, 0, 1, &frameSet,
                            0, nullptr);
    drawFullscreen(cmd, pipeline.handle);
}

} // namespace limn::render
