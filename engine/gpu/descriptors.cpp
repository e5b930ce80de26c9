// SPDX-License-Identifier: MIT
#include "engine/gpu/descriptors.h"

#include "engine/gpu/vulkan_error.h"

#include <vector>

namespace limn::gpu {

Sampler createSampler(Device& device, const SamplerDesc& desc) {
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = desc.filter;
    info.mipmapMode = desc.mipmaps;
    info.addressModeU = desc.wrapU;
    info.addressModeV = desc.wrapV;
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.maxLod = VK_LOD_CLAMP_NONE;
    info.compareEnable = desc.compare;
    info.compareOp = VK_COMPARE_OP_GREATER_OR_EQUAL;
    VkSampler sampler = VK_NULL_HANDLE;
    VK_CHECK(vkCreateSampler(device.device, &info, nullptr, &sampler));
    return {device, sampler};
}

DescriptorSetLayout createSetLayout(Device& device, std::span<const VkDescriptorType> types) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (std::uint32_t i = 0; i < types.size(); ++i)
        bindings.push_back({i, types[i], 1, VK_SHADER_STAGE_ALL, nullptr});
    VkDescriptorSetLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    info.bindingCount = std::uint32_t(bindings.size());
    info.pBindings = bindings.data();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    VK_CHECK(vkCreateDescriptorSetLayout(device.device, &info, nullptr, &layout));
    return {device, layout};
}

DescriptorPool createDescriptorPool(Device& device, std::uint32_t sets,
                                    std::span<const VkDescriptorType> types) {
    std::vector<VkDescriptorPoolSize> sizes;
    for (VkDescriptorType type : types)
        sizes.push_back({type, sets});
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.maxSets = sets;
    info.poolSizeCount = std::uint32_t(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VK_CHECK(vkCreateDescriptorPool(device.device, &info, nullptr, &pool));
    return {device, pool};
}

VkDescriptorSet allocateSet(Device& device, const DescriptorPool& pool,
                            const DescriptorSetLayout& layout) {
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool.handle;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout.handle;
    VkDescriptorSet set = VK_NULL_HANDLE;
    VK_CHECK(vkAllocateDescriptorSets(device.device, &info, &set));
    return set;
}

static VkWriteDescriptorSet write(VkDescriptorSet set, std::uint32_t binding,
                                  VkDescriptorType type) {
    VkWriteDescriptorSet w{};
    w.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    w.dstSet = set;
    w.dstBinding = binding;
    w.descriptorCount = 1;
    w.descriptorType = type;
    return w;
}

void writeBuffer(Device& device, VkDescriptorSet set, std::uint32_t binding, VkDescriptorType type,
                 VkBuffer buffer, VkDeviceSize offset, VkDeviceSize range) {
    const VkDescriptorBufferInfo info{buffer, offset, range};
    VkWriteDescriptorSet w = write(set, binding, type);
    w.pBufferInfo = &info;
    vkUpdateDescriptorSets(device.device, 1, &w, 0, nullptr);
}

void writeTexture(Device& device, VkDescriptorSet set, std::uint32_t binding, VkImageView view,
                  VkSampler sampler) {
    const VkDescriptorImageInfo info{sampler, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet w = write(set, binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    w.pImageInfo = &info;
    vkUpdateDescriptorSets(device.device, 1, &w, 0, nullptr);
}

void writeStorageImage(Device& device, VkDescriptorSet set, std::uint32_t binding,
                       VkImageView view) {
    const VkDescriptorImageInfo info{VK_NULL_HANDLE, view, VK_IMAGE_LAYOUT_GENERAL};
    VkWriteDescriptorSet w = write(set, binding, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE);
    w.pImageInfo = &info;
    vkUpdateDescriptorSets(device.device, 1, &w, 0, nullptr);
}

} // namespace limn::gpu
