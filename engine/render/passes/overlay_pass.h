// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/overlay/overlay_data.h"
#include "engine/render/passes/geometry_passes.h"

#include <memory>

namespace limn::render {

/// Draws an overlay's marks and texel colours, or the triangles' edges, over a finished picture.
/// Creates its buffers when there
/// is something to draw and its pipelines when it first draws.
class OverlayPass {
public:
    explicit OverlayPass(gpu::Device& device) : m_device(device) {}

    /// Uploads `data` if the pointer changed. If it is null or empty, nothing is drawn and no
    /// buffer is kept.
    void set(std::shared_ptr<const OverlayData> data);

    bool active() const { return m_markCount > 0 || bool(m_texels); }

    /// Records the overlay into the bound colour attachment (kColorFormat). The bound depth
    /// attachment is that of SurfaceImages for the same view. `pixelSize` is a pixel's height at
    /// distance 1; `slot` is that of MaterialSet. With `wireframe`, triangles' edges are drawn too,
    /// even if this is not active().
    void record(VkCommandBuffer cmd, const RenderScene& scene, const GeometryView& view,
                float pixelSize, std::uint32_t slot, bool wireframe);

private:
    void makePipelines();
    void drawSurfaces(VkCommandBuffer cmd, const RenderScene& scene, const GeometryView& view,
                      const gpu::Pipeline& pipeline, bool lightmappedOnly);
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
    gpu::Pipeline m_base, m_surface, m_line, m_mark; ///< m_line: null where the device has none
};

} // namespace limn::render
