// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/descriptors.h"
#include "engine/gpu/image.h"
#include "engine/render/shadows/light_table.h"
#include "engine/render/shadows/shadow_maps.h"
#include "engine/render/surfaces/surface_images.h"
#include "shaders/shared/gpu_frame.h"

#include <array>
#include <cstdint>

namespace limn::render {

/// Types of the bindings of set 0 of all passes over a picture, of gpu_frame.h.
inline constexpr std::array<VkDescriptorType, FRAME_BINDINGS> kFrameTypes = {
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,         VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};

/// Set 0 of all passes over a picture, one for each frame slot: what is seen in each pixel, and the
/// lights. What else a pass binds is in sets of its own.
class FrameSets {
public:
    explicit FrameSets(gpu::Device& device);

    const gpu::DescriptorSetLayout& layout() const { return m_layout; }
    VkDescriptorSet set(std::uint32_t slot) const { return m_sets[slot]; }

    /// Binds all of the slot's set. `frame`: a GpuFrame. `lookupSnaps`: those of the scene; empty:
    /// none. No frame in flight may use the slot.
    void write(std::uint32_t slot, const gpu::Buffer& frame, const LightTable& lights,
               const ShadowMaps& shadows, const SurfaceImages& surfaces,
               const gpu::Buffer& lookupSnaps);

    /// Some image, for bindings that nothing reads.
    VkImageView filler() const { return m_reflections.view; }

private:
    gpu::Device& m_device;
    gpu::DescriptorSetLayout m_layout;
    gpu::DescriptorPool m_pool;
    std::array<VkDescriptorSet, kFrameSlots> m_sets{};
    gpu::Image m_reflections; ///< limn::reflectionTable()
    gpu::Sampler m_smooth, m_texels;
};

} // namespace limn::render
