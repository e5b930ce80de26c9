// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/render/viewport.h"
#include "shaders/shared/gpu_photon_bounce.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace limn {

/// The first bounces of a light's photons on the device: reflective shadow maps that a viewport
/// draws, and a compute shader that scatters the photon of each texel as scatter() does. Not
/// thread-safe.
class GpuBounces {
public:
    /// Both outlive the object. The device can bind two storage buffers at once.
    GpuBounces(gpu::Device& device, Viewport& viewport);

    /// Draws the maps of a light, as unitLight() makes it, of `scene`, which the viewport shows,
    /// and returns what becomes of each texel's photon, in the order of the texels of castRsm().
    /// `side`: texels along a side of a view. None where there is nothing to draw; std::nullopt
    /// where the device cannot bind that many. Waits for the device.
    std::optional<std::vector<shared::GpuBounce>> bounce(const Scene& scene, const Light& light,
                                                         std::uint32_t side);

    std::uint64_t dispatches() const { return m_dispatches; } ///< so far
    std::uint64_t views() const { return m_views; }           ///< drawn so far
    /// Device memory of images and bounces [bytes].
    std::uint64_t bytes() const { return m_mapBytes + m_bounces.size + m_glass.size; }

private:
    void bind(const SurfaceMap& map);

    gpu::Device& m_device;
    Viewport& m_viewport;
    gpu::Buffer m_bounces, m_glass;
    gpu::DescriptorSetLayout m_setLayout;
    gpu::DescriptorPool m_pool;
    VkDescriptorSet m_set = VK_NULL_HANDLE;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_pipeline;
    std::uint64_t m_dispatches = 0, m_views = 0, m_mapBytes = 0;
};

} // namespace limn
