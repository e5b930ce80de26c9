// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/pipeline.h"

namespace limn::render {

/// Of a pass that runs `fragment` once in every pixel; specialisation constants may be added.
gpu::GraphicsPipelineDesc fullscreenDesc(gpu::Spirv fragment, VkPipelineLayout layout,
                                         VkFormat format, const char* name);

/// With the pipeline of such a pass; sets and constants are bound.
void drawFullscreen(VkCommandBuffer cmd, VkPipeline pipeline);

} // namespace limn::render
