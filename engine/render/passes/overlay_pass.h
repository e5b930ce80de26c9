// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/overlay/overlay_data.h"
#include "engine/render/passes/geometry_passes.h"

#include <memory>

namespace limn::render {

/// Draws a bake's marks and texel colours over a finished picture. Makes its buffers when there is
/// something to draw, its pipelines when it first draws.
class OverlayPass {
public:
    explicit OverlayPass(gpu::Device& device) : m_device(device) {}

    /// Uploads where the pointer is new. Null, or nothing in it: nothing is drawn and no buffer is
    /// kept.
    void set(std::shared_ptr<const OverlayData> data);

    bool active() const { return m_markCount > 0 || bool(m_texels); }

    /// Into the bound colour attachment (kColorFormat) and depth attachment; the depth is that of
    /// SurfaceImages with the same view. `pixelSize`: a pixel's height at distance 1; `slot` as in
    /// MaterialSet.
    void record(VkCommandBuffer cmd, const RenderScene& scene, const GeometryView& view,
                float pixelSize, std::uint32_t slot);

private:
    void makePipelines();
    void drawSurfaces(VkCommandBuffer cmd, const RenderScene& scene, const GeometryView& view,
                      bool texels);
    void drawMarks(VkCommandBuffer cmd, const GeometryView& view, float pixelSize);

    gpu::Device& m_device;
    std::shared_ptr<const OverlayData> m_data;
    gpu::Buffer m_marks;  ///< OverlayMark
    gpu::Buffer m_texels; ///< width, height, then OverlayData::texels
    std::uint32_t m_markCount = 0;
    gpu::DescriptorSetLayout m_setLayout;
    gpu::DescriptorPool m_pool;
    std::vector<VkDescriptorSet> m_sets; ///< per slot
    gpu::PipelineLayout m_surfaceLayout, m_markLayout;
    gpu::Pipeline m_base, m_surface, m_mark;
};

} // namespace limn::render
