// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include <vulkan/vulkan.h>

namespace limn::render {

/// Size of a picture [pixels], which fills this corner of its images.
struct Extent {
    std::uint32_t width = 0, height = 0;
    bool operator==(const Extent&) const = default;
};

/// Describes an attachment of a rendering and what happens to its previous contents.
VkRenderingAttachmentInfo attachment(VkImageView view, VkImageLayout layout,
                                     VkAttachmentLoadOp load, VkClearValue clear = {});

/// Begins dynamic rendering; `depth` may be null. In clip space y points down, or up if `up`.
void beginRendering(VkCommandBuffer cmd, Extent size,
                    std::span<const VkRenderingAttachmentInfo> colors,
                    const VkRenderingAttachmentInfo* depth, bool up);

} // namespace limn::render
