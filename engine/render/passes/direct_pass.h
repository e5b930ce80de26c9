// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/pipeline.h"
#include "engine/scene/view.h"

#include <map>

namespace limn::render {

/// Adds direct light to the linear image, once per pixel. Otherwise every light would be evaluated
/// many times for triangles far smaller than the pixel blocks that hardware and software
/// rasterisers shade.
class DirectPass {
public:
    DirectPass(gpu::Device& device, VkDescriptorSetLayout frameLayout);

    /// Records the pass into the bound linear image. `frameSet` holds the surface and depth images.
    void record(VkCommandBuffer cmd, VkDescriptorSet frameSet, View view);

private:
    gpu::Device& m_device;
    gpu::PipelineLayout m_layout;
    std::map<View, gpu::Pipeline> m_pipelines;
};

} // namespace limn::render
