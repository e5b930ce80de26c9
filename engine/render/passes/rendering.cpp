// SPDX-License-Identifier: MIT
#include "engine/render/passes/rendering.h"

namespace limn::render {

VkRenderingAttachmentInfo attachment(VkImageView view, VkImageLayout layout,
                                     VkAttachmentLoadOp load, VkClearValue clear) {
    return {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = view,
            .imageLayout = layout,
            .loadOp = load,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .clearValue = clear};
}

void beginRendering(VkCommandBuffer cmd, Extent size,
                    std::span<const VkRenderingAttachmentInfo> colors,
                    const VkRenderingAttachmentInfo* depth, bool up) {
    const VkRect2D area{{0, 0}, {size.width, size.height}};
    const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                               .renderArea = area,
                               .layerCount = 1,
                               .colorAttachmentCount = std::uint32_t(colors.size()),
                               .pColorAttachments = colors.data(),
                               .pDepthAttachment = depth};
    vkCmdBeginRendering(cmd, &info);
    const auto w = float(size.width), h = float(size.height);
    const VkViewport viewport = up ? VkViewport{0, h, w, -h, 0, 1} : VkViewport{0, 0, w, h, 0, 1};
    vkCmdSetViewport(cmd, 0, 1, &viewport);
    vkCmdSetScissor(cmd, 0, 1, &area);
}

void discardContents(VkCommandBuffer cmd, const gpu::Image& image, gpu::Access read) {
    read.access = VK_ACCESS_2_NONE;
    read.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    gpu::imageBarrier(cmd, image.handle, VK_IMAGE_ASPECT_COLOR_BIT, read, gpu::kColorWrite);
}

void makeReadable(VkCommandBuffer cmd, const gpu::Image& image) {
    gpu::imageBarrier(cmd, image.handle, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kColorWrite,
                      gpu::kFragmentRead);
}

} // namespace limn::render
