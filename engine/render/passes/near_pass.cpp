// SPDX-License-Identifier: MIT
#include "engine/render/passes/near_pass.h"

#include "engine/math/sh.h"
#include "engine/render/passes/fullscreen.h"
#include "engine/render/passes/geometry_passes.h"
#include "shaders/shared/gpu_near.h"
#include "shaders/viewport/near.frag.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace limn::render {

using shared::GpuNear;

NearPass::NearPass(gpu::Device& device, VkDescriptorSetLayout frameLayout)
    : m_device(device), m_frameLayout(frameLayout), m_surfaces(device),
      m_lightmap(device, VK_FILTER_LINEAR) {}

void NearPass::set(const Scene& scene, std::shared_ptr<const LightmapLayout> layout,
                   std::uint64_t version) {
    m_surfaces.take(scene, std::move(layout), version);
}

bool NearPass::prepare(const ViewportOptions& options) {
    if (options.nearRays > 0 && showsBouncedLight(options.view))
        m_surfaces.prepare();
    return active(options);
}

bool NearPass::active(const ViewportOptions& options) const {
    return options.nearRays > 0 && showsBouncedLight(options.view) && m_surfaces.any();
}

VkPipeline NearPass::pipeline(const Variant& variant) {
    if (!m_layout) {
        const std::array layouts = {m_frameLayout, m_surfaces.layout(), m_lightmap.layout()};
        m_layout = gpu::createPipelineLayout(m_device, layouts, sizeof(GpuNear), "near light");
    }
    gpu::Pipeline& pipeline = m_pipelines[variant];
    if (!pipeline) {
        auto desc = fullscreenDesc(kNearFrag, m_layout.handle, kLinearFormat, "near light");
        desc.blend = gpu::Blend::Add;
        desc.constants = {std::uint32_t(variant.view), 0, variant.bands, variant.chroma};
        pipeline = gpu::createGraphicsPipeline(m_device, desc);
    }
    return pipeline.handle;
}

void NearPass::record(VkCommandBuffer cmd, VkDescriptorSet frameSet, const ViewportOptions& options,
                      const GpuField& field, std::uint32_t sample, std::uint32_t slot) {
    assert(active(options));
    const VkPipeline variant = pipeline(
        {options.view, std::min(field.bands, std::uint32_t(kIrradianceBands)), field.chroma});
    const std::array sets = {frameSet, m_surfaces.set(), m_lightmap.set(slot)};
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_layout.handle, 0, sets.size(),
                            sets.data(), 0, nullptr);
    const GpuNear push{.rays = options.nearRays, .first = sample * options.nearRays};
    vkCmdPushConstants(cmd, m_layout.handle, VK_SHADER_STAGE_ALL, 0, sizeof push, &push);
    drawFullscreen(cmd, variant);
}

} // namespace limn::render
