// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/handle.h"

#include <span>

namespace limn::gpu {

struct SamplerDesc {
    VkFilter filter = VK_FILTER_LINEAR;
    VkSamplerMipmapMode mipmaps = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    VkSamplerAddressMode wrapU = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    VkSamplerAddressMode wrapV = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    bool compare = false; ///< depth comparison: reference >= texel, for depths of 1 near and 0 far
};
Sampler createSampler(Device& device, const SamplerDesc& desc);

/// Creates a layout in which binding i is one descriptor of types[i], visible to every stage.
DescriptorSetLayout createSetLayout(Device& device, std::span<const VkDescriptorType> types);

/// Creates a pool for `sets` sets, each with one descriptor per entry of `types`.
DescriptorPool createDescriptorPool(Device& device, std::uint32_t sets,
                                    std::span<const VkDescriptorType> types);
VkDescriptorSet allocateSet(Device& device, const DescriptorPool& pool,
                            const DescriptorSetLayout& layout);

void writeBuffer(Device& device, VkDescriptorSet set, std::uint32_t binding, VkDescriptorType type,
                 VkBuffer buffer, VkDeviceSize offset = 0, VkDeviceSize range = VK_WHOLE_SIZE);
/// Writes a combined image sampler. The image is in SHADER_READ_ONLY_OPTIMAL.
void writeTexture(Device& device, VkDescriptorSet set, std::uint32_t binding, VkImageView view,
                  VkSampler sampler);

/// Writes a storage image for shaders to write. The image is in GENERAL.
void writeStorageImage(Device& device, VkDescriptorSet set, std::uint32_t binding,
                       VkImageView view);

} // namespace limn::gpu
