// SPDX-License-Identifier: MIT
#include "engine/render/tonemap_pass.h"

#include "engine/render/material_set.h"
#include "shaders/fullscreen.vert.h"
#include "shaders/tonemap.frag.h"

namespace limn::render {

using shared::GpuTonemap;

static_assert(std::uint32_t(Tonemap::Aces) == TONEMAP_ACES &&
              std::uint32_t(Tonemap::Agx) == TONEMAP_AGX &&
              std::uint32_t(Tonemap::PbrNeutral) == TONEMAP_PBR_NEUTRAL);

TonemapPass::TonemapPass(gpu::Device& device) : m_device(device) {
    const std::array types = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};
    m_setLayout = gpu::createSetLayout(device, types);
    m_pool = gpu::createDescriptorPool(device, kFrameSlots, types);
    for (std::uint32_t i = 0; i < kFrameSlots; ++i)
        m_sets.push_back(gpu::allocateSet(device, m_pool, m_setLayout));
    m_sampler = gpu::createSampler(
        device, {.filter = VK_FILTER_NEAREST, .mipmaps = VK_SAMPLER_MIPMAP_MODE_NEAREST});
    const std::array layouts = {m_setLayout.handle};
    m_layout = gpu::createPipelineLayout(device, layouts, sizeof(GpuTonemap), "tone mapping");
    gpu::GraphicsPipelineDesc desc;
    desc.vertex = kFullscreenVert;
    desc.fragment = kTonemapFrag;
    desc.layout = m_layout.handle;
    desc.colorFormats = {kColorFormat};
    desc.name = "tone mapping";
    m_pipeline = gpu::createGraphicsPipeline(device, desc);
}

void TonemapPass::record(VkCommandBuffer cmd, VkImageView linear, const GpuTonemap& push,
                         std::uint32_t slot) {
    gpu::writeTexture(m_device, m_sets[slot], 0, linear, m_sampler.handle);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_pipeline.handle);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_layout.handle, 0, 1,
                            &m_sets[slot], 0, nullptr);
    vkCmdPushConstants(cmd, m_layout.handle, VK_SHADER_STAGE_ALL, 0, sizeof push, &push);
    vkCmdDraw(cmd, 3, 1, 0, 0);
}

} // namespace limn::render
