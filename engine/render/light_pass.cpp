// SPDX-License-Identifier: MIT
#include "engine/render/light_pass.h"

#include "engine/render/passes/fullscreen.h"
#include "engine/render/passes/geometry_passes.h"

namespace limn {

LightPipelines::LightPipelines(gpu::Device& device, VkDescriptorSetLayout frameLayout,
                               std::span<const VkDescriptorSetLayout> setLayouts,
                               gpu::Spirv fragment, std::vector<std::uint32_t> constants,
                               const char* name)
    : m_device(device), m_fragment(fragment), m_constants(std::move(constants)), m_name(name) {
    std::vector<VkDescriptorSetLayout> layouts = {frameLayout};
    layouts.insert(layouts.end(), setLayouts.begin(), setLayouts.end());
    m_layout = gpu::createPipelineLayout(device, layouts, 0, name);
}

void LightPipelines::draw(const LightPassFrame& frame, std::span<const VkDescriptorSet> sets) {
    gpu::Pipeline& pipeline = m_pipelines[{frame.view, frame.diffuse}];
    if (!pipeline) {
        auto desc =
            render::fullscreenDesc(m_fragment, m_layout.handle, render::kLinearFormat, m_name);
        desc.blend = gpu::Blend::Add;
        desc.constants = {std::uint32_t(frame.view), std::uint32_t(frame.diffuse)};
        desc.constants.insert(desc.constants.end(), m_constants.begin(), m_constants.end());
        pipeline = gpu::createGraphicsPipeline(m_device, desc);
    }
    std::vector<VkDescriptorSet> all = {frame.frame};
    all.insert(all.end(), sets.begin(), sets.end());
    vkCmdBindDescriptorSets(frame.cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_layout.handle, 0,
                            std::uint32_t(all.size()), all.data(), 0, nullptr);
    render::drawFullscreen(frame.cmd, pipeline.handle);
}

} // namespace limn
