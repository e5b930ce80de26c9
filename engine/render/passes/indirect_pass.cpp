// SPDX-License-Identifier: MIT
#include "engine/render/passes/indirect_pass.h"

#include "engine/render/passes/fullscreen.h"
#include "shaders/shared/gpu_frame.h"
#include "shaders/viewport/indirect.frag.h"

namespace limn::render {

namespace {

constexpr VkDescriptorType kFieldBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
constexpr std::array<VkDescriptorType, FIELD_BINDINGS> kFieldTypes = {
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFieldBuffer, kFieldBuffer};

} // namespace

IndirectPass::IndirectPass(gpu::Device& device, VkDescriptorSetLayout frameLayout)
    : m_device(device), m_setLayout(gpu::createSetLayout(device, kFieldTypes)),
      m_pool(gpu::createDescriptorPool(device, kFrameSlots, kFieldTypes)),
      m_sampler(gpu::createSampler(device, {.mipmaps = VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                            .wrapU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                            .wrapV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE})) {
    for (VkDescriptorSet& set : m_sets)
        set = gpu::allocateSet(device, m_pool, m_setLayout);
    m_layout = gpu::createPipelineLayout(device, std::array{frameLayout, m_setLayout.handle}, 0,
                                         "indirect light");
}

void IndirectPass::bind(const GpuField& field, std::uint32_t slot) {
    const VkDescriptorSet set = m_sets[slot];
    const auto bindBuffer = [&](std::uint32_t binding, const gpu::Buffer* buffer) {
        // What the field does not have is not read.
        gpu::writeBuffer(m_device, set, binding, kFieldBuffer,
                         buffer ? buffer->handle : field.grid.handle);
    };
    gpu::writeTexture(m_device, set, FIELD_LIGHTMAP, field.lightmap.view, m_sampler.handle);
    bindBuffer(FIELD_GRID, &field.grid);
    bindBuffer(FIELD_GRID_WEIGHTS, field.gridDepth.get());
    m_chroma[slot] = field.chroma;
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
                          const SurfacesDrawn& surfaces, std::uint32_t slot) {
    const std::array sets = {frameSet, m_sets[slot]};
    const std::uint32_t chroma = m_chroma[slot];
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_layout.handle, 0, sets.size(),
                            sets.data(), 0, nullptr);
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
