// SPDX-License-Identifier: MIT
#include "engine/render/surfaces/surface_images.h"

#include "engine/gpu/barrier.h"

#include <array>

namespace limn::render {

/// A software rasteriser spends most of its time on shading, but that of pictures up to this wide
/// on triangles, which a pass ahead draws twice [px].
constexpr std::uint32_t kSmall = 256;

void SurfaceImages::ensure(Extent size) {
    if (depth && size.width <= depth.width && size.height <= depth.height)
        return;
    const auto target = [&](VkFormat format, const char* name) {
        return gpu::Image(m_device,
                          gpu::ImageDesc::renderTarget(size.width, size.height, format, name));
    };
    depth = target(kDepthFormat, "depth");
    surface = target(kSurfaceFormat, "surface");
    emitted = target(kLinearFormat, "emitted radiance");
    receiver = target(kReceiverFormat, "receiver");
    forget();
}

bool SurfaceImages::record(VkCommandBuffer cmd, GeometryPasses& geometry, const RenderScene& scene,
                           const MaterialSet& materials, const GeometryView& view, Extent size,
                           std::uint32_t slot, VkDescriptorSet frameSet) {
    const Contents wanted{view, size, scene.version, materials.version};
    if (m_holds == wanted)
        return false;
    m_holds = wanted;
    const std::array images = {&emitted, &surface, &receiver};
    gpu::Access before = gpu::kFragmentRead; // by the previous frame; contents are cleared
    before.access = VK_ACCESS_2_NONE;
    before.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    std::array<VkRenderingAttachmentInfo, images.size()> colors;
    for (std::size_t i = 0; i < images.size(); ++i) {
        gpu::imageBarrier(cmd, images[i]->handle, VK_IMAGE_ASPECT_COLOR_BIT, before,
                          gpu::kColorWrite);
        colors[i] = attachment(images[i]->view, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                               VK_ATTACHMENT_LOAD_OP_CLEAR);
    }
    gpu::imageBarrier(cmd, depth.handle, VK_IMAGE_ASPECT_DEPTH_BIT, before, gpu::kDepthWrite);
    auto depths = attachment(depth.view, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                             VK_ATTACHMENT_LOAD_OP_CLEAR);
    if (m_device.softwareRasteriser && size.width > kSmall) {
        beginRendering(cmd, size, {}, &depths, true);
        geometry.drawDepthAhead(cmd, scene, materials, view);
        vkCmdEndRendering(cmd);
        gpu::memoryBarrier(cmd, gpu::kDepthWrite, gpu::kDepthWrite);
        depths.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    }
    beginRendering(cmd, size, colors, &depths, true);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, geometry.layout(), 0, 1,
                            &frameSet, 0, nullptr);
    m_drawn = geometry.drawSurfaces(cmd, scene, materials, view, slot);
    vkCmdEndRendering(cmd);
    for (const gpu::Image* image : images)
        gpu::imageBarrier(cmd, image->handle, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kColorWrite,
                          gpu::kFragmentRead);
    gpu::imageBarrier(cmd, depth.handle, VK_IMAGE_ASPECT_DEPTH_BIT, gpu::kDepthWrite,
                      gpu::kFragmentRead);
    return true;
}

} // namespace limn::render
