// SPDX-License-Identifier: MIT
#include "engine/render/passes/overlay_pass.h"

#include "engine/core/log.h"
#include "engine/gpu/uploader.h"
#include "engine/render/passes/tonemap_pass.h"
#include "shaders/shared/gpu_overlay.h"
#include "shaders/viewport/overlay_base.frag.h"
#include "shaders/viewport/overlay_line.frag.h"
#include "shaders/viewport/overlay_mark.frag.h"
#include "shaders/viewport/overlay_mark.vert.h"
#include "shaders/viewport/overlay_surface.frag.h"
#include "shaders/viewport/overlay_surface.vert.h"

#include <array>
#include <cstddef>
#include <utility>

#include <glm/matrix.hpp>

namespace limn::render {

using shared::GpuOverlayMarks;
using shared::GpuOverlaySurface;

static_assert(std::uint32_t(MarkShape::Disc) == MARK_DISC &&
              std::uint32_t(MarkShape::Square) == MARK_SQUARE &&
              std::uint32_t(MarkShape::Ring) == MARK_RING);

void OverlayPass::set(std::shared_ptr<const OverlayData> data) {
    if (data == m_data)
        return;
    m_data = std::move(data);
    m_marks = {};
    m_texels = {};
    m_markCount = 0;
    if (!m_data)
        return;
    gpu::Uploader uploader(m_device);
    m_markCount = std::uint32_t(m_data->marks.size());
    if (m_markCount > 0)
        m_marks = uploader.buffer(std::as_bytes(std::span(m_data->marks)),
                                  VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, "overlay marks");
    if (m_data->texels.empty())
        return;
    std::vector<std::uint32_t> words = {m_data->width, m_data->height};
    words.insert(words.end(), m_data->texels.begin(), m_data->texels.end());
    words.insert(words.end(), m_data->finer.begin(), m_data->finer.end());
    if (words.size() * sizeof words[0] > m_device.properties.limits.maxStorageBufferRange)
        logWarning("the lightmap has more texels than this device can show as an overlay");
    else
        m_texels = uploader.buffer(std::as_bytes(std::span(words)),
                                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "overlay texels");
}

static gpu::GraphicsPipelineDesc surfaceDesc(VkPipelineLayout layout, gpu::Spirv fragment) {
    gpu::GraphicsPipelineDesc desc;
    desc.vertex = kOverlaySurfaceVert;
    desc.fragment = fragment;
    desc.layout = layout;
    desc.bindings = {{0, sizeof(glm::vec3), VK_VERTEX_INPUT_RATE_VERTEX},
                     {1, sizeof(glm::vec2), VK_VERTEX_INPUT_RATE_VERTEX}};
    desc.attributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0}, {1, 1, VK_FORMAT_R32G32_SFLOAT, 0}};
    desc.colorFormats = {kColorFormat};
    desc.depthFormat = kDepthFormat;
    // Fragments that an alpha mask removed differ in depth from what is seen.
    desc.depthCompare = VK_COMPARE_OP_EQUAL;
    desc.depthWrite = false;
    desc.name = "overlay on surfaces";
    return desc;
}

static gpu::GraphicsPipelineDesc markDesc(VkPipelineLayout layout) {
    gpu::GraphicsPipelineDesc desc;
    desc.vertex = kOverlayMarkVert;
    desc.fragment = kOverlayMarkFrag;
    desc.layout = layout;
    desc.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    desc.bindings = {{0, sizeof(OverlayMark), VK_VERTEX_INPUT_RATE_INSTANCE}};
    desc.attributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(OverlayMark, position)},
                       {1, 0, VK_FORMAT_R32_SFLOAT, offsetof(OverlayMark, radius)},
                       {2, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(OverlayMark, normal)},
                       {3, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(OverlayMark, color)},
                       {4, 0, VK_FORMAT_R32_UINT, offsetof(OverlayMark, shape)}};
    desc.colorFormats = {kColorFormat};
    desc.depthFormat = kDepthFormat;
    desc.depthCompare = VK_COMPARE_OP_GREATER;
    desc.name = "overlay marks";
    return desc;
}

void OverlayPass::makePipelines() {
    const std::array types = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
    m_setLayout = gpu::createSetLayout(m_device, types);
    m_pool = gpu::createDescriptorPool(m_device, kFrameSlots, types);
    for (std::uint32_t i = 0; i < kFrameSlots; ++i)
        m_sets.push_back(gpu::allocateSet(m_device, m_pool, m_setLayout));
    const std::array layouts = {m_setLayout.handle};
    m_surfaceLayout = gpu::createPipelineLayout(m_device, layouts, sizeof(GpuOverlaySurface),
                                                "overlay on surfaces");
    m_markLayout =
        gpu::createPipelineLayout(m_device, {}, sizeof(GpuOverlayMarks), "overlay marks");
    gpu::GraphicsPipelineDesc base = surfaceDesc(m_surfaceLayout.handle, kOverlayBaseFrag);
    base.blend = gpu::Blend::Add;
    m_base = gpu::createGraphicsPipeline(m_device, base);
    m_surface = gpu::createGraphicsPipeline(
        m_device, surfaceDesc(m_surfaceLayout.handle, kOverlaySurfaceFrag));
    if (m_device.wireframe) {
        gpu::GraphicsPipelineDesc line = surfaceDesc(m_surfaceLayout.handle, kOverlayLineFrag);
        line.wireframe = line.depthBias = true;
        line.depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL; // depth falls with distance
        line.name = "wireframe";
        m_line = gpu::createGraphicsPipeline(m_device, line);
    }
    m_mark = gpu::createGraphicsPipeline(m_device, markDesc(m_markLayout.handle));
}

void OverlayPass::drawSurfaces(VkCommandBuffer cmd, const RenderScene& scene,
                               const GeometryView& view, const gpu::Pipeline& pipeline,
                               bool lightmappedOnly) {
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.handle);
    for (const GpuInstance& instance : scene.instances) {
        const GpuMesh& mesh = scene.meshes[instance.mesh];
        if (mesh.indexCount == 0 || (lightmappedOnly && !instance.hasLightmap) ||
            !mayBeVisible(instance.bounds, view.toClip))
            continue;
        GpuOverlaySurface draw{};
        draw.toClip = view.toClip * instance.toWorld;
        const glm::mat4 rows = glm::transpose(instance.toWorld);
        for (int r = 0; r < 3; ++r)
            draw.toWorld[r] = rows[r];
        draw.eye = view.eye;
        draw.sideOffset = instance.mirrored ? -instance.backOffset : instance.backOffset;
        vkCmdPushConstants(cmd, m_surfaceLayout.handle, VK_SHADER_STAGE_ALL, 0, sizeof draw, &draw);
        const std::array buffers = {mesh.positions.handle, instance.hasLightmap
                                                               ? instance.lightmapUv.handle
                                                               : mesh.positions.handle};
        const std::array<VkDeviceSize, 2> offsets{};
        vkCmdBindVertexBuffers(cmd, 0, 2, buffers.data(), offsets.data());
        vkCmdBindIndexBuffer(cmd, mesh.indices.handle, 0, VK_INDEX_TYPE_UINT32);
        vkCmdDrawIndexed(cmd, mesh.indexCount, 1, 0, 0, 0);
    }
}

void OverlayPass::drawMarks(VkCommandBuffer cmd, const GeometryView& view, float pixelSize) {
    const GpuOverlayMarks push{view.toClip, view.eye, pixelSize};
    const VkDeviceSize offset = 0;
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_mark.handle);
    vkCmdPushConstants(cmd, m_markLayout.handle, VK_SHADER_STAGE_ALL, 0, sizeof push, &push);
    vkCmdBindVertexBuffers(cmd, 0, 1, &m_marks.handle, &offset);
    vkCmdDraw(cmd, 4, m_markCount, 0, 0);
}

void OverlayPass::record(VkCommandBuffer cmd, const RenderScene& scene, const GeometryView& view,
                         float pixelSize, std::uint32_t slot, bool wireframe) {
    if (!m_mark)
        makePipelines();
    drawSurfaces(cmd, scene, view, m_base, false);
    if (m_texels) {
        gpu::writeBuffer(m_device, m_sets[slot], 0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                         m_texels.handle);
        vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, m_surfaceLayout.handle, 0, 1,
                                &m_sets[slot], 0, nullptr);
        drawSurfaces(cmd, scene, view, m_surface, true);
    }
    if (wireframe && m_line) {
        constexpr float kTowardsViewer = 2; // steps of depth, and of its slope
        vkCmdSetDepthBias(cmd, kTowardsViewer, 0, kTowardsViewer);
        drawSurfaces(cmd, scene, view, m_line, false);
    }
    if (m_markCount > 0)
        drawMarks(cmd, view, pixelSize);
}

} // namespace limn::render
