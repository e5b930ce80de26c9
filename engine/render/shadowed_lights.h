// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include <vulkan/vulkan.h>

namespace limn {

/// Maximum number of layers in the shadow atlas. One layer holds the map of one directional light.
inline constexpr std::uint32_t kMaxShadowLayers = 32;

/// Lights with their shadow maps on the GPU, as the viewport's shaders read them. The handles
/// belong to whoever returned this struct.
struct ShadowedLights {
    VkBuffer lights = VK_NULL_HANDLE;      ///< array of shared::GpuLight, then values of profiles
    VkBuffer shadowViews = VK_NULL_HANDLE; ///< array of shared::GpuShadowView
    VkImageView atlas = VK_NULL_HANDLE;    ///< depth layers, in SHADER_READ_ONLY_OPTIMAL
    VkSampler sampler = VK_NULL_HANDLE;    ///< nearest
    std::uint32_t count = 0;               ///< lights
    float normalBias = 0, lightBias = 0;   ///< offsets of receivers [shadow texels]
    /// One hash per light of everything that its light depends on besides its colour and strength.
    /// Comparable only while `casters` stays the same.
    std::span<const std::uint64_t> shapes;
    std::uint64_t casters = 0; ///< changes whenever the shadow casters change
    std::uint64_t version = 0; ///< increases with every change of the lights or shadow casters
};

} // namespace limn
