// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/descriptors.h"
#include "engine/render/surfaces/material_set.h"

#include <array>

namespace limn::render {

/// One descriptor set per frame slot with one texture, for passes that read one image.
class SlotTexture {
public:
    explicit SlotTexture(gpu::Device& device, VkFilter filter = VK_FILTER_NEAREST)
        : m_device(device) {
        const std::array types = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};
        m_layout = gpu::createSetLayout(device, types);
        m_pool = gpu::createDescriptorPool(device, kFrameSlots, types);
        for (VkDescriptorSet& set : m_sets)
            set = gpu::allocateSet(device, m_pool, m_layout);
        m_sampler = gpu::createSampler(device, {.filter = filter,
                                                .mipmaps = VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                                .wrapU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                                .wrapV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE});
    }

    VkDescriptorSetLayout layout() const { return m_layout.handle; }

    /// Binds `view`, an image in SHADER_READ_ONLY_OPTIMAL, to the slot's set and returns the set.
    /// No frame in flight may use the slot.
    VkDescriptorSet with(VkImageView view, std::uint32_t slot) {
        gpu::writeTexture(m_device, m_sets[slot], 0, view, m_sampler.handle);
        return m_sets[slot];
    }

    /// The set of what with() bound last.
    VkDescriptorSet set(std::uint32_t slot) const { return m_sets[slot]; }

private:
    gpu::Device& m_device;
    gpu::DescriptorSetLayout m_layout;
    gpu::DescriptorPool m_pool;
    gpu::Sampler m_sampler;
    std::array<VkDescriptorSet, kFrameSlots> m_sets{};
};

} // namespace limn::render
