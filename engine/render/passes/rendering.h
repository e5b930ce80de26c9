// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include <vulkan/vulkan.h>

namespace limn::render {

/// A picture's size [pixels]: the corner of its images that is drawn.
struct Extent {
    std::uint32_t width = 0, height = 0;
    bool operator==(const Extent&) const = default;
};

/// Where a rendering draws, and what becomes of what is there.
VkRenderingAttachmentInfo attachment(VkImageView view, VkImageLayout layout,
                                     VkAttachmentLoadOp load, VkClearValue clear = {});

/// Begins dynamic rendering; `depth` may be null. Clip space is y down, or up where `up`.
void beginRendering(VkCommandBuffer cmd, Extent size,
                    std::span<const VkRenderingAttachmentInfo> colors,
                    const VkRenderingAttachmentInfo* depth, bool up);

} // namespace limn::render
