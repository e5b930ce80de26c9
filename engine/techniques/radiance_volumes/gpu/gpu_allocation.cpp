// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/gpu/gpu_allocation.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/uploader.h"
#include "engine/shading/pixel_rays.h"
#include "engine/techniques/radiance_volumes/gpu/volume_pass.h"
#include "shaders/radiance_volumes/volume_demand.comp.h"
#include "shaders/radiance_volumes/volume_missed.comp.h"

#include <array>
#include <cstring>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

namespace limn {

using shared::GpuPlaceSums;
using shared::GpuVolumeDemand;

namespace {

constexpr std::array kDemandTypes = {
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
static_assert(kDemandTypes.size() == VOLUME_DEMAND_BINDINGS);
static_assert(VOLUME_PLACE_UNIT == kPlaceUnit);

/// Depth is depthOffset + depthScale / distance, since the third row of the projection is linear
/// in the fourth.
GpuVolumeDemand pictureOf(const Viewpoint& view, glm::uvec2 size, const SurfaceMapView& drawn) {
    const glm::mat4 rows = glm::transpose(drawn.toClip);
    const glm::vec3 depth(rows[2]), distance(rows[3]);
    const float offset = glm::dot(depth, distance) / glm::dot(distance, distance);
    const PixelRays rays(view.camera, size.x, size.y);
    return {.eye = rays.eye,
            .depthOffset = offset,
            .rayCentre = rays.centre,
            .depthScale = rows[2].w - offset * rows[3].w,
            .rayRight = rays.right,
            .width = size.x,
            .rayUp = rays.up,
            .height = size.y};
}

} // namespace

GpuAllocation::GpuAllocation(gpu::Device& device, Viewport& viewport)
    : m_device(device), m_viewport(viewport),
      m_grids(device, {.size = sizeof(shared::GpuCacheGrids),
                       .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                       .memory = gpu::MemoryKind::Upload,
                       .name = "grids of caches"}),
      m_missed(device, {.size = sizeof(std::uint32_t),
                        .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                        .memory = gpu::MemoryKind::Readback,
                        .name = "pixels without caches"}),
      m_setLayout(gpu::createSetLayout(device, kDemandTypes)),
      m_pool(gpu::createDescriptorPool(device, 1, kDemandTypes)),
      m_set(gpu::allocateSet(device, m_pool, m_setLayout)),
      m_layout(gpu::createPipelineLayout(device, std::array{m_setLayout.handle},
                                         sizeof(GpuVolumeDemand), "caches wanted")),
      m_demand(gpu::createComputePipeline(device, kVolumeDemandComp, m_layout.handle, {},
                                          "caches wanted")),
      m_count(gpu::createComputePipeline(device, kVolumeMissedComp, m_layout.handle, {},
                                         "pixels without caches")) {}

/// A view that is drawn for a step to read.
struct GpuAllocation::Picture {
    Camera camera;
    glm::uvec2 size;
    GpuVolumeDemand constants;
};

/// Draws the view, and runs a step for each pixel. `nodes`: what it binds for them.
void GpuAllocation::draw(const Picture& picture, const gpu::Pipeline& step,
                         const gpu::Buffer& nodes) {
    m_viewport.readSurfaces(
        picture.camera, picture.size, [&](VkCommandBuffer cmd, const SurfaceMap& map, std::size_t) {
            gpu::writeTexture(m_device, m_set, VOLUME_DEMAND_SURFACE, map.surface, map.sampler);
            gpu::writeTexture(m_device, m_set, VOLUME_DEMAND_DEPTH, map.depth, map.sampler);
            const auto bind = [&](std::uint32_t binding, const gpu::Buffer& buffer) {
                gpu::writeBuffer(m_device, m_set, binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                 buffer.handle);
            };
            bind(VOLUME_DEMAND_GRIDS, m_grids);
            bind(VOLUME_DEMAND_SUMS, nodes);
            bind(VOLUME_DEMAND_MISSED, m_missed);
            vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, step.handle);
            vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, m_layout.handle, 0, 1,
                                    &m_set, 0, nullptr);
            vkCmdPushConstants(cmd, m_layout.handle, VK_SHADER_STAGE_ALL, 0,
                               sizeof picture.constants, &picture.constants);
            vkCmdDispatch(cmd, gpu::groups(picture.size.x, VOLUME_MAP_LANES),
                          gpu::groups(picture.size.y, VOLUME_MAP_LANES), 1);
            gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kAllReads);
            gpu::memoryBarrier(cmd, gpu::kComputeWrite, gpu::kHostRead);
            ++m_dispatches;
        });
}

/// Pixels miss caches only where some were dropped.
std::size_t GpuAllocation::countMissed(const Picture& picture, const CacheAllocation& made) {
    if (made.droppedCount == 0)
        return 0;
    gpu::Uploader uploader(m_device);
    const gpu::Buffer address =
        uploader.buffer(std::as_bytes(std::span(made.address)), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                        "addresses of caches");
    uploader.flush();
    auto& missed = *static_cast<std::uint32_t*>(m_missed.mapped);
    missed = 0;
    draw(picture, m_count, address);
    return missed;
}

std::optional<CacheAllocation> GpuAllocation::allocate(const Scene& scene, const Viewpoint& view,
                                                       const VolumeSettings& settings) {
    const CacheGrids grids = cascadesAbout(view.camera.eye, scene.bounds, settings.cascades,
                                           settings.nodes, settings.transition);
    if (grids.grids.empty())
        return CacheAllocation();
    const VkDeviceSize bytes = grids.nodes() * sizeof(GpuPlaceSums);
    if (bytes > m_device.properties.limits.maxStorageBufferRange)
        return {};
    if (m_sums.size != bytes)
        m_sums = {m_device,
                  {.size = bytes,
                   .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                            VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                   .name = "caches wanted"}};
    const shared::GpuCacheGrids onDevice = gpuCacheGrids(grids, {}, glm::vec3(0));
    std::memcpy(m_grids.mapped, &onDevice, sizeof onDevice);
    const glm::uvec2 size = pictureSize(view);
    const SurfaceMapView drawn =
        surfaceMapOf(view.camera, float(size.x) / float(size.y), scene.bounds);
    const Picture picture{view.camera, size, pictureOf(view, size, drawn)};
    m_device.immediate("clear caches wanted", [&](VkCommandBuffer cmd) {
        vkCmdFillBuffer(cmd, m_sums.handle, 0, VK_WHOLE_SIZE, 0);
        gpu::memoryBarrier(cmd, gpu::kTransferWrite, gpu::kComputeWrite);
    });
    draw(picture, m_demand, m_sums);
    std::vector<GpuPlaceSums> sums(grids.nodes());
    gpu::readBuffer(m_device, m_sums, std::as_writable_bytes(std::span(sums)));
    WantedNodes wanted(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i)
        wanted[i] = sums[i].surfaces > 0 ? 1 : 0;
    CacheAllocation made = numberCaches(grids, wanted, settings.caches);
    for (std::size_t g = 0; g < grids.grids.size(); ++g)
        for (std::size_t i = grids.firstNode(g); i < grids.firstNode(g + 1); ++i)
            if (made.address[i] != kNoCache) {
                CachePlace& place = made.places[made.address[i]];
                place = placeOf({sums[i].surfaces, sums[i].x, sums[i].y, sums[i].z, sums[i].height,
                                 sums[i].shiftX, sums[i].shiftY, sums[i].shiftZ},
                                place.position, grids.grids[g].cell);
            }
    made.missed = countMissed(picture, made);
    made.shown = middlesOfTriangles(scene);
    return made;
}

} // namespace limn
