// SPDX-License-Identifier: MIT
#include "engine/gpu/image.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/vulkan_error.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

namespace limn::gpu {

ImageDesc ImageDesc::renderTarget(std::uint32_t width, std::uint32_t height, VkFormat format,
                                  const char* name) {
    const bool depth = aspectOf(format) == VK_IMAGE_ASPECT_DEPTH_BIT;
    return {.width = width,
            .height = height,
            .format = format,
            .usage = VkImageUsageFlags(depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                             : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT) |
                     VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
            .name = name};
}

ImageDesc ImageDesc::texture(std::uint32_t width, std::uint32_t height, VkFormat format,
                             std::uint32_t mips, const char* name) {
    return {.width = width,
            .height = height,
            .mips = mips,
            .format = format,
            .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
            .name = name};
}

ImageDesc ImageDesc::volume(glm::uvec3 size, VkFormat format, std::uint32_t mips,
                            const char* name) {
    return {.width = size.x,
            .height = size.y,
            .depth = size.z,
            .mips = mips,
            .format = format,
            .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                     VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
            .name = name};
}

VkImageAspectFlags aspectOf(VkFormat format) {
    return format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM
               ? VK_IMAGE_ASPECT_DEPTH_BIT
               : VK_IMAGE_ASPECT_COLOR_BIT;
}

std::uint32_t mipCount(std::uint32_t width, std::uint32_t height, std::uint32_t depth) {
    return std::uint32_t(std::bit_width(std::max({width, height, depth, 1u})));
}

static VkImageView createView(Device& device, const Image& image, VkImageViewType type,
                              std::uint32_t baseLayer, std::uint32_t layers) {
    const VkImageViewCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .image = image.handle,
        .viewType = type,
        .format = image.format,
        .components = {},
        .subresourceRange = {aspectOf(image.format), 0, image.mips, baseLayer, layers}};
    VkImageView view = VK_NULL_HANDLE;
    VK_CHECK(vkCreateImageView(device.device, &info, nullptr, &view));
    return view;
}

Image::Image(Device& device, const ImageDesc& desc)
    : width(desc.width), height(desc.height), layers(desc.layers), mips(desc.mips),
      depth(desc.depth), format(desc.format), m_device(&device) {
    assert(width > 0 && height > 0 && layers > 0 && mips > 0);
    assert(depth == 0 || layers == 1);
    const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .pNext = nullptr,
                                 .flags = 0,
                                 .imageType = depth > 0 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D,
                                 .format = format,
                                 .extent = {width, height, std::max(depth, 1u)},
                                 .mipLevels = mips,
                                 .arrayLayers = layers,
                                 .samples = VK_SAMPLE_COUNT_1_BIT,
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = desc.usage,
                                 .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
                                 .queueFamilyIndexCount = 0,
                                 .pQueueFamilyIndices = nullptr,
                                 .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
    VK_CHECK(vkCreateImage(device.device, &info, nullptr, &handle));
    VkMemoryRequirements requirements;
    vkGetImageMemoryRequirements(device.device, handle, &requirements);
    try {
        m_memory = device.memory.allocate(requirements, MemoryKind::Gpu, true);
    } catch (...) {
        vkDestroyImage(device.device, handle, nullptr);
        throw;
    }
    VK_CHECK(vkBindImageMemory(device.device, handle, m_memory.memory, m_memory.offset));
    device.setName(VK_OBJECT_TYPE_IMAGE, std::uint64_t(handle), desc.name);
    const bool array = desc.array || layers > 1;
    view = createView(device, *this,
                      depth > 0 ? VK_IMAGE_VIEW_TYPE_3D
                      : array   ? VK_IMAGE_VIEW_TYPE_2D_ARRAY
                                : VK_IMAGE_VIEW_TYPE_2D,
                      0, layers);
    for (std::uint32_t i = 0; desc.layerViews && i < layers; ++i)
        layerViews.push_back(createView(device, *this, VK_IMAGE_VIEW_TYPE_2D, i, 1));
}

Image::~Image() {
    if (!handle)
        return;
    m_device->retire(
        [d = m_device, h = handle, v = view, views = std::move(layerViews), memory = m_memory] {
            for (VkImageView layer : views)
                vkDestroyImageView(d->device, layer, nullptr);
            vkDestroyImageView(d->device, v, nullptr);
            vkDestroyImage(d->device, h, nullptr);
            d->memory.free(memory);
        });
}

void Image::swap(Image& other) noexcept {
    std::swap(handle, other.handle);
    std::swap(view, other.view);
    std::swap(layerViews, other.layerViews);
    std::swap(width, other.width);
    std::swap(height, other.height);
    std::swap(layers, other.layers);
    std::swap(mips, other.mips);
    std::swap(depth, other.depth);
    std::swap(format, other.format);
    std::swap(m_memory, other.m_memory);
    std::swap(m_device, other.m_device);
}

static VkDeviceSize texelBytes(VkFormat format) {
    switch (int(format)) {
    case VK_FORMAT_R8_UNORM:
    case VK_FORMAT_R8_UINT:
        return 1;
    case VK_FORMAT_E5B9G9R9_UFLOAT_PACK32:
    case VK_FORMAT_R8G8B8A8_UNORM:
    case VK_FORMAT_R8G8B8A8_SRGB:
    case VK_FORMAT_B8G8R8A8_UNORM:
    case VK_FORMAT_R32_SFLOAT:
    case VK_FORMAT_R32_UINT:
    case VK_FORMAT_D32_SFLOAT:
        return 4;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
        return 8;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
        return 16;
    }
    assert(!"a format nobody copies yet");
    return 0;
}

static Buffer stage(Device& device, std::span<const std::byte> bytes) {
    Buffer staging(device, {.size = bytes.size(),
                            .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                            .memory = MemoryKind::Upload,
                            .name = "staging"});
    std::memcpy(staging.mapped, bytes.data(), bytes.size());
    return staging;
}

// Returns the bytes read.
static VkDeviceSize copyMip(VkCommandBuffer cmd, const Buffer& staging, VkDeviceSize offset,
                            const Image& image, std::uint32_t mip) {
    const std::uint32_t w = std::max(image.width >> mip, 1u), h = std::max(image.height >> mip, 1u),
                        d = std::max(image.depth >> mip, 1u);
    const VkBufferImageCopy region{
        .bufferOffset = offset,
        .bufferRowLength = 0,
        .bufferImageHeight = 0,
        .imageSubresource = {aspectOf(image.format), mip, 0, image.layers},
        .imageOffset = {},
        .imageExtent = {w, h, d}};
    vkCmdCopyBufferToImage(cmd, staging.handle, image.handle, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           1, &region);
    return VkDeviceSize(w) * h * d * image.layers * texelBytes(image.format);
}

void uploadImage(Device& device, VkCommandBuffer cmd, const Image& image,
                 std::span<const std::byte> bytes) {
    const Buffer staging = stage(device, bytes);
    const VkImageAspectFlags aspect = aspectOf(image.format);
    imageBarrier(cmd, image.handle, aspect, kUndefined, kTransferWrite);
    VkDeviceSize offset = 0;
    for (std::uint32_t mip = 0; mip < image.mips; ++mip)
        offset += copyMip(cmd, staging, offset, image, mip);
    assert(offset == bytes.size());
    imageBarrier(cmd, image.handle, aspect, kTransferWrite, kFragmentRead);
}

void uploadImageMakingMips(Device& device, VkCommandBuffer cmd, const Image& image,
                           std::span<const std::byte> bytes) {
    assert(image.depth == 0 && image.layers == 1);
    const Buffer staging = stage(device, bytes);
    const VkImageAspectFlags aspect = aspectOf(image.format);
    imageBarrier(cmd, image.handle, aspect, kUndefined, kTransferWrite);
    copyMip(cmd, staging, 0, image, 0);
    const auto extent = [](std::uint32_t size, std::uint32_t mip) {
        return std::int32_t(std::max(size >> mip, 1u));
    };
    for (std::uint32_t mip = 1; mip < image.mips; ++mip) {
        imageBarrier(cmd, image.handle, aspect, kTransferWrite, kTransferRead, mip - 1, 1);
        VkImageBlit region{};
        region.srcSubresource = {aspect, mip - 1, 0, 1};
        region.srcOffsets[1] = {extent(image.width, mip - 1), extent(image.height, mip - 1), 1};
        region.dstSubresource = {aspect, mip, 0, 1};
        region.dstOffsets[1] = {extent(image.width, mip), extent(image.height, mip), 1};
        vkCmdBlitImage(cmd, image.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image.handle,
                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_LINEAR);
    }
    if (image.mips > 1)
        imageBarrier(cmd, image.handle, aspect, kTransferRead, kFragmentRead, 0, image.mips - 1);
    imageBarrier(cmd, image.handle, aspect, kTransferWrite, kFragmentRead, image.mips - 1, 1);
}

/// Whatever used the image before, or will use it, in `layout`.
static Access anyUse(VkImageLayout layout) {
    Access outside = kAllWrites;
    outside.access |= VK_ACCESS_2_MEMORY_READ_BIT;
    outside.layout = layout;
    return outside;
}

void sampleImage(Device& device, const Image& from, std::uint32_t width, std::uint32_t height,
                 const Image& to, VkImageLayout layout) {
    assert(width <= from.width && height <= from.height);
    const VkImageAspectFlags aspect = aspectOf(from.format);
    const Access outside = anyUse(layout);
    device.immediate("sample image", [&](VkCommandBuffer cmd) {
        imageBarrier(cmd, from.handle, aspect, outside, kTransferRead);
        imageBarrier(cmd, to.handle, aspect, kUndefined, kTransferWrite);
        const VkImageBlit region{
            .srcSubresource = {aspect, 0, 0, 1},
            .srcOffsets = {{0, 0, 0}, {std::int32_t(width), std::int32_t(height), 1}},
            .dstSubresource = {aspect, 0, 0, 1},
            .dstOffsets = {{0, 0, 0}, {std::int32_t(to.width), std::int32_t(to.height), 1}}};
        vkCmdBlitImage(cmd, from.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.handle,
                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_NEAREST);
        imageBarrier(cmd, from.handle, aspect, kTransferRead, outside);
        imageBarrier(cmd, to.handle, aspect, kTransferWrite, outside);
    });
}

void readImage(Device& device, const Image& image, VkImageLayout layout, std::uint32_t width,
               std::uint32_t height, std::span<std::byte> out, std::uint32_t layers) {
    assert(width <= image.width && height <= image.height && layers <= image.layers);
    const std::uint32_t depth = std::max(image.depth, 1u);
    assert(out.size() == VkDeviceSize(width) * height * depth * layers * texelBytes(image.format));
    const Buffer staging(device, {.size = out.size(),
                                  .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                  .memory = MemoryKind::Readback,
                                  .name = "read-back"});
    const VkImageAspectFlags aspect = aspectOf(image.format);
    const Access outside = anyUse(layout);
    device.immediate("read image", [&](VkCommandBuffer cmd) {
        imageBarrier(cmd, image.handle, aspect, outside, kTransferRead);
        const VkBufferImageCopy region{.bufferOffset = 0,
                                       .bufferRowLength = 0,
                                       .bufferImageHeight = 0,
                                       .imageSubresource = {aspect, 0, 0, layers},
                                       .imageOffset = {},
                                       .imageExtent = {width, height, depth}};
        vkCmdCopyImageToBuffer(cmd, image.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                               staging.handle, 1, &region);
        imageBarrier(cmd, image.handle, aspect, kTransferRead, outside);
        memoryBarrier(cmd, kTransferWrite, kHostRead);
    });
    std::memcpy(out.data(), staging.mapped, out.size());
}

} // namespace limn::gpu
