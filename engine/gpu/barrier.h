// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <vulkan/vulkan.h>

namespace limn::gpu {

/// A kind of access to a resource, with the layout that it needs for images.
struct Access {
    VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 access = VK_ACCESS_2_NONE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

/// A fresh image: its contents are not needed and there is nothing to wait for.
inline constexpr Access kUndefined{};
inline constexpr Access kColorWrite{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                    VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                                        VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
                                    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
inline constexpr Access kDepthWrite{
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL};
inline constexpr Access kFragmentRead{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                      VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
inline constexpr Access kComputeWrite{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                      VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                                          VK_ACCESS_2_SHADER_STORAGE_READ_BIT,
                                      VK_IMAGE_LAYOUT_GENERAL};
inline constexpr Access kTransferRead{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                      VK_ACCESS_2_TRANSFER_READ_BIT,
                                      VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
inline constexpr Access kTransferWrite{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                       VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
inline constexpr Access kPresent{VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE,
                                 VK_IMAGE_LAYOUT_PRESENT_SRC_KHR};
/// For memory only, not for images.
inline constexpr Access kHostRead{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT,
                                  VK_IMAGE_LAYOUT_UNDEFINED};
inline constexpr Access kAllReads{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT,
                                  VK_IMAGE_LAYOUT_UNDEFINED};
inline constexpr Access kAllWrites{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                   VK_ACCESS_2_MEMORY_WRITE_BIT, VK_IMAGE_LAYOUT_UNDEFINED};

/// Records a barrier: accesses `from` complete and become visible before any access `to`. Layouts
/// are ignored.
void memoryBarrier(VkCommandBuffer cmd, const Access& from, const Access& to);

/// The same for one image, including its layout transition. Covers all mips and layers by default.
void imageBarrier(VkCommandBuffer cmd, VkImage image, VkImageAspectFlags aspect, const Access& from,
                  const Access& to, std::uint32_t baseMip = 0,
                  std::uint32_t mips = VK_REMAINING_MIP_LEVELS, std::uint32_t baseLayer = 0,
                  std::uint32_t layers = VK_REMAINING_ARRAY_LAYERS);

} // namespace limn::gpu
