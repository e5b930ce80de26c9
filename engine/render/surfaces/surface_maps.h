// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/descriptors.h"
#include "engine/render/surface_map.h"
#include "engine/render/surfaces/surface_images.h"

#include <span>

namespace limn::render {

/// Draws what other views than the picture's see of the surfaces.
class SurfaceMaps {
public:
    /// `frameTypes` are the bindings of `frameLayout`, of which the first is a GpuFrame; they
    /// outlive the object.
    SurfaceMaps(gpu::Device& device, const gpu::DescriptorSetLayout& frameLayout,
                std::span<const VkDescriptorType> frameTypes);

    /// Draws the views and lets `read` record what reads them, as Viewport::drawSurfaceMaps().
    /// `filler` is an image for bindings that nothing reads; `slot` is that of MaterialSet. Waits
    /// for the GPU.
    void draw(GeometryPasses& geometry, const RenderScene& scene, const MaterialSet& materials,
              VkImageView filler, std::uint32_t slot, std::span<const SurfaceMapView> views,
              glm::uvec2 size, const ReadSurfaceMap& read);

    /// `images` as shaders read them.
    SurfaceMap mapOf(const SurfaceImages& images, VkImageView albedo) const;

private:
    void writeSet(VkImageView filler);

    gpu::Device& m_device;
    std::span<const VkDescriptorType> m_frameTypes;
    SurfaceImages m_images;
    gpu::Buffer m_frame; ///< 0 but for the eye, which is all that surfaces read of it
    gpu::Sampler m_sampler;
    gpu::DescriptorPool m_pool;
    VkDescriptorSet m_set;
};

} // namespace limn::render
