// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/pipeline.h"

namespace limn::render {

/// Pipeline description of a pass that runs `fragment` once per pixel. The caller may add
/// specialisation constants.
gpu::GraphicsPipelineDesc fullscreenDesc(gpu::Spirv fragment, VkPipelineLayout layout,
                                         VkFormat format, const char* name);

/// Draws with the pipeline of such a pass. Descriptor sets and push constants must be bound.
void drawFullscreen(VkCommandBuffer cmd, VkPipeline pipeline);

} // namespace limn::render
