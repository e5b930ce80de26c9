// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include <vulkan/vulkan.h>

namespace limn {

/// The largest number of layers that the atlas of shadow maps has; each has room for a sun.
inline constexpr std::uint32_t kMaxShadowLayers = 32;

/// Lights with their shadow maps on the GPU, as the viewport's shaders read them. Owned by whoever
/// handed it out.
struct ShadowedLights {
    VkBuffer lights = VK_NULL_HANDLE;      ///< shared::GpuLight each
    VkBuffer shadowViews = VK_NULL_HANDLE; ///< shared::GpuShadowView each
    VkImageView atlas = VK_NULL_HANDLE;    ///< depth layers, in SHADER_READ_ONLY_OPTIMAL
    VkSampler sampler = VK_NULL_HANDLE;    ///< nearest
    std::uint32_t count = 0;               ///< lights
    float normalBias = 0, lightBias = 0;   ///< receivers are moved so far [shadow texels]
    /// Of each light a hash of all but its colour and strength that its light depends on, as long
    /// as `casters` is the same.
    std::span<const std::uint64_t> shapes;
    std::uint64_t casters = 0; ///< another one whenever what casts shadows has changed
    std::uint64_t version = 0; ///< grows with every change of the lights or of what casts shadows
};

} // namespace limn
