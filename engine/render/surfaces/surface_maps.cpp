// SPDX-License-Identifier: MIT
#include "engine/render/surfaces/surface_maps.h"

#include "engine/gpu/barrier.h"
#include "shaders/shared/gpu_frame.h"

#include <cassert>
#include <cstring>

namespace limn::render {

SurfaceMaps::SurfaceMaps(gpu::Device& device, const gpu::DescriptorSetLayout& frameLayout,
                         std::span<const VkDescriptorType> frameTypes)
    : m_device(device), m_frameTypes(frameTypes), m_images(device),
      m_frame(device,
              {.size = sizeof(shared::GpuFrame),
               .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
               .memory = gpu::MemoryKind::Upload,
               .name = "frame of surface maps"}),
      m_sampler(gpu::createSampler(
          device, {.filter = VK_FILTER_NEAREST, .mipmaps = VK_SAMPLER_MIPMAP_MODE_NEAREST})),
      m_pool(gpu::createDescriptorPool(device, 1, frameTypes)),
      m_set(gpu::allocateSet(device, m_pool, frameLayout)) {
    std::memset(m_frame.mapped, 0, sizeof(shared::GpuFrame));
}

// A view without light reads the frame alone, but drivers look at all descriptors.
void SurfaceMaps::writeSet(VkImageView filler) {
    for (std::uint32_t binding = 0; binding < m_frameTypes.size(); ++binding)
        if (m_frameTypes[binding] == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER)
            gpu::writeTexture(m_device, m_set, binding, filler, m_sampler.handle);
        else
            gpu::writeBuffer(m_device, m_set, binding, m_frameTypes[binding], m_frame.handle);
}

void SurfaceMaps::draw(GeometryPasses& geometry, const RenderScene& scene,
                       const MaterialSet& materials, VkImageView filler, std::uint32_t slot,
                       std::span<const SurfaceMapView> views, glm::uvec2 size,
                       const ReadSurfaceMap& read) {
    assert(size.x > 0 && size.y > 0);
    m_images.ensure({size.x, size.y});
    writeSet(filler);
    constexpr std::uint64_t kTexelBytes = 3 * 16 + 4;
    const SurfaceMap map{.albedo = m_images.emitted.view,
                         .surface = m_images.surface.view,
                         .depth = m_images.depth.view,
                         .receiver = m_images.receiver.view,
                         .sampler = m_sampler.handle,
                         .bytes = kTexelBytes * m_images.depth.width * m_images.depth.height};
    m_device.immediate("surface maps", [&](VkCommandBuffer cmd) {
        for (std::size_t k = 0; k < views.size(); ++k) {
            GeometryView view;
            view.view = View::Albedo;
            view.toClip = views[k].toClip;
            gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads); // after the last view
            m_images.forget();
            m_images.record(cmd, geometry, scene, materials, view, {size.x, size.y}, slot, m_set);
            gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kAllReads);
            read(cmd, map, k);
        }
    });
}

} // namespace limn::render
