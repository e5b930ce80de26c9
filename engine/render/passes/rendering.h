// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/barrier.h"
#include "engine/gpu/image.h"

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

/// Discards a colour image's contents, to draw to it once the accesses `read` of the previous frame
/// have completed.
void discardContents(VkCommandBuffer cmd, const gpu::Image& image, gpu::Access read);

/// Makes what was drawn to a colour image readable in fragment shaders.
void makeReadable(VkCommandBuffer cmd, const gpu::Image& image);

} // namespace limn::render
