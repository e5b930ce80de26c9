// SPDX-License-Identifier: MIT
#include "engine/render/point_irradiance.h"

#include "engine/gpu/barrier.h"
#include "shaders/shared/gpu_point_irradiance.h"
#include "shaders/viewport/point_irradiance.comp.h"

#include <algorithm>
#include <array>

namespace limn {

static constexpr VkDescriptorType kBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
static constexpr std::array kTypes = {kBuffer, kBuffer, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                      kBuffer, kBuffer, kBuffer,
                                      kBuffer};
static constexpr std::uint32_t kLanes = 64;

// The shadow maps of all lights may exceed any memory cache, so all points read those of a few
// lights at a time.
static constexpr std::uint32_t kLightsAtOnce = 16;

PointIrradiance::PointIrradiance(gpu::Device& device, const PointBuffers& buffers)
    : m_device(device), m_buffers(buffers), m_kept(device, buffers.count),
      m_setLayout(gpu::createSetLayout(device, kTypes)),
      m_pool(gpu::createDescriptorPool(device, 1, kTypes)),
      m_set(gpu::allocateSet(device, m_pool, m_setLayout)), m_times(device, 1) {
    const std::array layouts = {m_setLayout.handle};
    m_layout = gpu::createPipelineLayout(device, layouts, sizeof(shared::GpuPointLighting),
                                         "irradiance of points");
    const std::array constants = {kLanes, buffers.stride, buffers.together};
    m_pipeline = gpu::createComputePipeline(device, kPointIrradianceComp, m_layout.handle,
                                            constants, "irradiance of points");
    gpu::writeBuffer(device, m_set, 5, kBuffer, buffers.points);
    gpu::writeBuffer(device, m_set, 6, kBuffer, buffers.irradiance);
}

void PointIrradiance::pointsChanged() {
    m_version.reset();
    m_kept.forget();
}

VkDeviceSize PointIrradiance::bytes() const {
    return m_kept.unit.size + m_kept.places.size;
}

void PointIrradiance::dispatchLights(VkCommandBuffer cmd, const ShadowedLights& lights) {
    gpu::writeBuffer(m_device, m_set, 0, kBuffer, lights.lights);
    gpu::writeBuffer(m_device, m_set, 1, kBuffer, lights.shadowViews);
    gpu::writeTexture(m_device, m_set, 2, lights.atlas, lights.sampler);
    gpu::writeBuffer(m_device, m_set, 3, kBuffer, m_kept.unit.handle);
    gpu::writeBuffer(m_device, m_set, 4, kBuffer, m_kept.places.handle);
    gpu::memoryBarrier(cmd, gpu::kAllWrites, gpu::kAllReads); // after the shadow maps were drawn
    const std::uint32_t work = m_kept.fresh + lights.count - m_kept.kept;
    for (std::uint32_t first = 0; first == 0 || first < work; first += kLightsAtOnce) {
        const shared::GpuPointLighting range{.count = m_buffers.count,
                                             .lights = lights.count,
                                             .normalBias = lights.normalBias,
                                             .lightBias = lights.lightBias,
                                             .keptLights = m_kept.kept,
                                             .freshLights = m_kept.fresh,
                                             .workBegin = first,
                                             .workEnd = std::min(first + kLightsAtOnce, work)};
        dispatches += gpu::dispatch(m_device, cmd, m_pipeline.handle, m_layout.handle, m_set,
                                    std::as_bytes(std::span(&range, 1)),
                                    (m_buffers.count + kLanes - 1) / kLanes);
    }
}

void PointIrradiance::record(VkCommandBuffer cmd, const ShadowedLights& lights) {
    m_version = lights.version;
    m_kept.assign(lights);
    lightsComputed = m_kept.fresh + lights.count - m_kept.kept;
    m_times.begin(cmd);
    dispatchLights(cmd, lights);
    m_times.mark(cmd);
}

bool PointIrradiance::update(const ShadowedLights& lights) {
    lightsComputed = 0;
    ms = 0;
    if (isCurrent(lights))
        return false;
    m_device.immediate("irradiance of points", [&](VkCommandBuffer cmd) { record(cmd, lights); });
    finish();
    return true;
}

} // namespace limn
