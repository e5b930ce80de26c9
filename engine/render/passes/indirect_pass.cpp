// SPDX-License-Identifier: MIT
#include "engine/render/passes/indirect_pass.h"

#include "engine/render/passes/fullscreen.h"
#include "shaders/viewport/indirect.frag.h"

namespace limn::render {

IndirectPass::IndirectPass(gpu::Device& device, VkDescriptorSetLayout frameLayout)
    : m_device(device) {
    m_layout = gpu::createPipelineLayout(device, {&frameLayout, 1}, 0, "indirect light");
}

VkPipeline IndirectPass::pipeline(const Variant& variant) {
    gpu::Pipeline& pipeline = m_pipelines[variant];
    if (!pipeline) {
        auto desc = fullscreenDesc(kIndirectFrag, m_layout.handle, kLinearFormat, "indirect light");
        desc.constants = {
            std::uint32_t(variant.view),  variant.features, variant.bands,
            std::uint32_t(variant.first), variant.chroma,   std::uint32_t(variant.diffuse)};
        pipeline = gpu::createGraphicsPipeline(m_device, desc);
    }
    return pipeline.handle;
}

void IndirectPass::record(VkCommandBuffer cmd, VkDescriptorSet frameSet, View view, bool diffuse,
                          const SurfacesDrawn& surfaces, std::uint32_t chroma) {
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_layout.handle, 0, 1, &frameSet,
                            0, nullptr);
    bool first = true;
    for (std::uint32_t bands = 0; bands < surfaces.bands.size(); ++bands)
        if (surfaces.bands[bands]) {
            drawFullscreen(cmd, pipeline({view, surfaces.features, bands, chroma, first, diffuse}));
            first = false;
        }
    if (first) // no surface reads any
        drawFullscreen(cmd, pipeline({view, 0, kIrradianceBands, kIrradianceBands, true, diffuse}));
}

} // namespace limn::render
