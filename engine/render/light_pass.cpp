// SPDX-License-Identifier: MIT
#include "engine/render/light_pass.h"

#include "engine/render/passes/fullscreen.h"
#include "engine/render/passes/geometry_passes.h"

#include <array>

namespace limn {

LightPipelines::LightPipelines(gpu::Device& device, VkDescriptorSetLayout frameLayout,
                               LightPassShader shader)
    : m_device(device), m_shader(std::move(shader)),
      m_setLayout(gpu::createSetLayout(device, m_shader.bindings)),
      m_layout(gpu::createPipelineLayout(device, std::array{frameLayout, m_setLayout.handle}, 0,
                                         m_shader.name)) {}

void LightPipelines::draw(const LightPassFrame& frame, VkDescriptorSet set) {
    gpu::Pipeline& pipeline = m_pipelines[{frame.view, frame.diffuse}];
    if (!pipeline) {
        auto desc = render::fullscreenDesc(m_shader.fragment, m_layout.handle,
                                           render::kLinearFormat, m_shader.name);
        desc.blend = gpu::Blend::Add;
        desc.constants = {std::uint32_t(frame.view), std::uint32_t(frame.diffuse)};
        desc.constants.insert(desc.constants.end(), m_shader.constants.begin(),
                              m_shader.constants.end());
        pipeline = gpu::createGraphicsPipeline(m_device, desc);
    }
    const std::array sets = {frame.frame, set};
    vkCmdBindDescriptorSets(frame.cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_layout.handle, 0,
                            std::uint32_t(sets.size()), sets.data(), 0, nullptr);
    render::drawFullscreen(frame.cmd, pipeline.handle);
}

std::shared_ptr<LightPipelines> LightPipelineCache::of(const LightPassShader& shader) {
    for (const auto& kept : m_kept)
        if (kept->shader().fragment.data() == shader.fragment.data() &&
            kept->shader().constants == shader.constants)
            return kept;
    return m_kept.emplace_back(std::make_shared<LightPipelines>(m_device, m_frameLayout, shader));
}

LightPassSet::LightPassSet(gpu::Device& device, std::shared_ptr<LightPipelines> pipelines)
    : m_device(device), m_pipelines(std::move(pipelines)),
      m_pool(gpu::createDescriptorPool(device, 1, m_pipelines->shader().bindings)),
      m_set(gpu::allocateSet(device, m_pool, m_pipelines->setLayout())) {}

void LightPassSet::bind(std::uint32_t binding, const gpu::Buffer& buffer) {
    gpu::writeBuffer(m_device, m_set, binding, m_pipelines->shader().bindings[binding],
                     buffer.handle);
}

} // namespace limn
