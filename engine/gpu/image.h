// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/device.h"

#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace limn::gpu {

struct ImageDesc {
    std::uint32_t width = 1, height = 1; ///< texels, > 0
    /// Texels of a 3D image, which has one layer; 0: the image is 2D.
    std::uint32_t depth = 0;
    std::uint32_t layers = 1;
    std::uint32_t mips = 1;
    VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT;
    bool array = false;      ///< the view is a 2D array even with one layer
    bool layerViews = false; ///< also one 2D view per layer, to draw into
    const char* name = "";

    /// An image to draw into, sample and read back.
    static ImageDesc renderTarget(std::uint32_t width, std::uint32_t height, VkFormat format,
                                  const char* name);
    /// An image to sample; filled by uploadImage().
    static ImageDesc texture(std::uint32_t width, std::uint32_t height, VkFormat format,
                             std::uint32_t mips, const char* name);
    /// A 3D image for compute shaders to write, and to sample, upload and read back.
    static ImageDesc volume(glm::uvec3 size, VkFormat format, std::uint32_t mips, const char* name);
};

/// Owns a VkImage, its memory and its views. Move-only; empty after a move; retires like Buffer.
class Image {
public:
    Image() = default;
    Image(Device& device, const ImageDesc& desc); ///< Throws VulkanError when out of memory.
    ~Image();
    Image(Image&& other) noexcept { swap(other); }
    Image& operator=(Image other) noexcept {
        swap(other);
        return *this;
    }
    explicit operator bool() const { return handle != VK_NULL_HANDLE; }

    VkImage handle = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;   ///< all mips and layers; of a 3D image, a 3D view
    std::vector<VkImageView> layerViews; ///< one per layer when asked for
    std::uint32_t width = 0, height = 0, layers = 0, mips = 0;
    std::uint32_t depth = 0; ///< 0: 2D
    VkFormat format = VK_FORMAT_UNDEFINED;

private:
    void swap(Image& other) noexcept;

    Allocation m_memory;
    Device* m_device = nullptr;
};

VkImageAspectFlags aspectOf(VkFormat format);

/// Number of mips in a full chain down to one texel.
std::uint32_t mipCount(std::uint32_t width, std::uint32_t height, std::uint32_t depth = 1);

/// Fills every mip and layer of `image` from `bytes`: mip after mip, in each layer after layer or
/// slice after slice, rows tightly packed. Leaves it in SHADER_READ_ONLY_OPTIMAL for fragment
/// shaders. The image must not have been used before; previous contents are lost.
void uploadImage(Device& device, VkCommandBuffer cmd, const Image& image,
                 std::span<const std::byte> bytes);

/// The same for mip 0 of a 2D image with one layer (TRANSFER_SRC too); the GPU fills the other mips
/// by repeated halving.
void uploadImageMakingMips(Device& device, VkCommandBuffer cmd, const Image& image,
                           std::span<const std::byte> bytes);

/// Fills all of `to` with texels of the corner (0, 0, width, height) of `from` in even steps,
/// without a filter. Both have one mip and layer, TRANSFER usage and `layout` before and after;
/// what `to` held is lost. Waits for the GPU.
void sampleImage(Device& device, const Image& from, std::uint32_t width, std::uint32_t height,
                 const Image& to, VkImageLayout layout);

/// Copies the corner (0, 0, width, height) of mip 0 of the first `layers` layers, or of all slices
/// of a 3D image, to the CPU, one after the other, rows tightly packed. The image is in `layout`
/// before and after. Waits for the GPU.
void readImage(Device& device, const Image& image, VkImageLayout layout, std::uint32_t width,
               std::uint32_t height, std::span<std::byte> out, std::uint32_t layers = 1);

} // namespace limn::gpu
