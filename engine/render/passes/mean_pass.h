// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/image.h"
#include "engine/gpu/pipeline.h"
#include "engine/render/passes/rendering.h"
#include "engine/render/surfaces/slot_texture.h"

#include <cstdint>

namespace limn::render {

/// Mixes a picture into the mean of others.
class MeanPass {
public:
    explicit MeanPass(gpu::Device& device);

    /// Makes of `mean`, the mean of `count` pictures, that of `count + 1`. Both are in
    /// SHADER_READ_ONLY_OPTIMAL for fragment shaders before and after; `slot` is that of
    /// MaterialSet.
    void record(VkCommandBuffer cmd, const gpu::Image& picture, const gpu::Image& mean,
                std::uint32_t count, Extent size, std::uint32_t slot);

private:
    SlotTexture m_picture;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_pipeline;
};

} // namespace limn::render
