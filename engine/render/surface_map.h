// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/camera.h"
#include "engine/scene/mesh/bounds.h"

#include <cstddef>
#include <cstdint>
#include <functional>

#include <glm/mat4x4.hpp>
#include <vulkan/vulkan.h>

namespace limn {

/// A view of which a map of surfaces is drawn.
struct SurfaceMapView {
    /// World to clip; y points up, and depth runs from 1 near to 0 far. Its axes form a
    /// right-handed system with the eye looking along -z.
    glm::mat4 toClip{1};
};

/// What a camera sees. Maps of this view have the pixels of a picture of `aspect`, width over
/// height, whose size they have. `bounds`: of the scene.
SurfaceMapView surfaceMapOf(const Camera& camera, float aspect, const Bounds& bounds);

/// The surfaces that such a view sees, for compute shaders: images in SHADER_READ_ONLY_OPTIMAL. The
/// handles belong to whoever returned this struct.
struct SurfaceMap {
    /// rgb: diffuse; 0 on the back of a one-sided surface. Of Viewport::readSurfaces(): some image
    /// that is not to be read.
    VkImageView albedo = VK_NULL_HANDLE;
    VkImageView surface = VK_NULL_HANDLE; ///< as packSurface() of surface_pack.glsl
    VkImageView depth = VK_NULL_HANDLE;   ///< 0 where there is no surface
    /// As surface.frag writes it.
    VkImageView receiver = VK_NULL_HANDLE;
    VkSampler sampler = VK_NULL_HANDLE; ///< nearest
    std::uint64_t bytes = 0;            ///< of the images, which are kept
};

/// Records work that reads the map of the view with that number.
using ReadSurfaceMap =
    std::function<void(VkCommandBuffer cmd, const SurfaceMap& map, std::size_t view)>;

} // namespace limn
