// SPDX-License-Identifier: MIT
#include "engine/render/surfaces/surface_maps.h"

#include "engine/gpu/barrier.h"
#include "shaders/shared/gpu_frame.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

namespace limn::render {

SurfaceMaps::SurfaceMaps(gpu::Device& device, const gpu::DescriptorSetLayout& frameLayout,
                         std::span<const VkDescriptorType> frameTypes)
    : m_device(device), m_frameTypes(frameTypes), m_images(device),
      m_frame(device,
              {.size = sizeof(shared::GpuFrame),
               .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                        VK_BUFFER_USAGE_TRANSFER_DST_BIT,
               .name = "frame of surface maps"}),
      m_sampler(gpu::createSampler(
          device, {.filter = VK_FILTER_NEAREST, .mipmaps = VK_SAMPLER_MIPMAP_MODE_NEAREST})),
      m_pool(gpu::createDescriptorPool(device, 1, frameTypes)),
      m_set(gpu::allocateSet(device, m_pool, frameLayout)) {}

/// From where a projection looks, by which normals are turned to the viewer. It is the point that
/// the projection takes to depth alone; a parallel one has it infinitely far away.
static glm::vec3 eyeOf(const glm::mat4& toClip) {
    constexpr double kFar = 1e8; // m
    const glm::dvec4 eye = glm::inverse(glm::dmat4(toClip))[2];
    const double length = glm::length(glm::dvec3(eye));
    return glm::vec3(glm::dvec3(eye) / std::max(std::abs(eye.w), length / kFar) *
                     (eye.w < 0 ? -1. : 1.));
}

// A view without light reads the frame alone, but drivers look at all descriptors.
void SurfaceMaps::writeSet(VkImageView filler) {
    for (std::uint32_t binding = 0; binding < m_frameTypes.size(); ++binding)
        if (m_frameTypes[binding] == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER)
            gpu::writeTexture(m_device, m_set, binding, filler, m_sampler.handle);
        else
            gpu::writeBuffer(m_device, m_set, binding, m_frameTypes[binding], m_frame.handle);
}

SurfaceMap SurfaceMaps::mapOf(const SurfaceImages& images, VkImageView albedo) const {
    constexpr std::uint64_t kTexelBytes = 3 * 16 + 4;
    return {.albedo = albedo,
            .surface = images.surface.view,
            .depth = images.depth.view,
            .receiver = images.receiver.view,
            .sampler = m_sampler.handle,
            .bytes = kTexelBytes * images.depth.width * images.depth.height};
}

void SurfaceMaps::draw(GeometryPasses& geometry, const RenderScene& scene,
                       const MaterialSet& materials, VkImageView filler, std::uint32_t slot,
                       std::span<const SurfaceMapView> views, glm::uvec2 size,
                       const ReadSurfaceMap& read) {
    assert(size.x > 0 && size.y > 0);
    m_images.ensure({size.x, size.y});
    writeSet(filler);
    const SurfaceMap map = mapOf(m_images, m_images.emitted.view);
    m_device.immediate("surface maps", [&](VkCommandBuffer cmd) {
        for (std::size_t k = 0; k < views.size(); ++k) {
            GeometryView view;
            view.view = View::Albedo;
            view.toClip = views[k].toClip;
            gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads); // after the last view
            shared::GpuFrame frame{};
            frame.eye = eyeOf(views[k].toClip);
            gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kTransferWrite);
            gpu::updateBuffer(m_device, cmd, m_frame, 0, std::as_bytes(std::span(&frame, 1)));
            m_images.forget();
            m_images.record(cmd, geometry, scene, materials, view, {size.x, size.y}, slot, m_set);
            gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kAllReads);
            read(cmd, map, k);
        }
    });
}

} // namespace limn::render
