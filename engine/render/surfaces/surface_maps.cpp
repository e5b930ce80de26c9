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
      m_frame(device, {.size = sizeof(shared::GpuFrame),
                       .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                       .memory = gpu::MemoryKind::Upload,
                       .name = "frame of surface maps"}),
      m_sampler(gpu::createSampler(
          device, {.filter = VK_FILTER_NEAREST, .mipmaps = VK_SAMPLER_MIPMAP_MODE_NEAREST})),
      m_pool(gpu::createDescriptorPool(device, 1, frameTypes)),
      m_set(gpu::allocateSet(device, m_pool, frameLayout)) {
    std::memset(m_frame.mapped, 0, sizeof(shared::GpuFrame));
}

// A view without light reads the frame alone, but drivers look at all descriptors.
void SurfaceMaps::writeSet(const GpuField& field) {
    gpu::writeBuffer(m_device, m_set, 0, m_frameTypes[0], m_frame.handle);
    for (std::uint32_t binding = 1; binding < m_frameTypes.size(); ++binding)
        if (m_frameTypes[binding] == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER)
            gpu::writeBuffer(m_device, m_set, binding, m_frameTypes[binding], field.grid.handle);
        else
            gpu::writeTexture(m_device, m_set, binding, field.lightmap.view, m_sampler.handle);
}

void SurfaceMaps::draw(GeometryPasses& geometry, const RenderScene& scene,
                       const MaterialSet& materials, const GpuField& field, std::uint32_t slot,
                       std::span<const SurfaceMapView> views, std::uint32_t size,
                       const ReadSurfaceMap& read) {
    assert(size > 0);
    m_images.ensure({size, size});
    writeSet(field);
    constexpr std::uint64_t kTexelBytes = 3 * 16 + 4;
    const SurfaceMap map{.albedo = m_images.emitted.view,
                         .surface = m_images.surface.view,
                         .depth = m_images.depth.view,
                         .sampler = m_sampler.handle,
                         .bytes = kTexelBytes * m_images.depth.width * m_images.depth.height};
    m_device.immediate("surface maps", [&](VkCommandBuffer cmd) {
        for (std::size_t k = 0; k < views.size(); ++k) {
            GeometryView view;
            view.view = View::Albedo;
            view.toClip = views[k].toClip;
            gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads); // after the last view
            m_images.forget();
            m_images.record(cmd, geometry, scene, materials, view, {size, size}, slot, m_set);
            gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kAllReads);
            read(cmd, map, k);
        }
    });
}

} // namespace limn::render
