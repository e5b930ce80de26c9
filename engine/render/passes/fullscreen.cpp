// SPDX-License-Identifier: MIT
#include "engine/render/passes/fullscreen.h"

#include "shaders/viewport/fullscreen.vert.h"

namespace limn::render {

gpu::GraphicsPipelineDesc fullscreenDesc(gpu::Spirv fragment, VkPipelineLayout layout,
                                         VkFormat format, const char* name) {
    gpu::GraphicsPipelineDesc desc;
    desc.vertex = kFullscreenVert;
    desc.fragment = fragment;
    desc.layout = layout;
    desc.colorFormats = {format};
    desc.name = name;
    return desc;
}

void drawFullscreen(VkCommandBuffer cmd, VkPipeline pipeline) {
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdDraw(cmd, 3, 1, 0, 0);
}

} // namespace limn::render
