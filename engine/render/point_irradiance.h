// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/gpu/timestamps.h"
#include "engine/render/kept_lights.h"
#include "engine/render/shadowed_lights.h"

#include <cstdint>
#include <optional>

namespace limn {

/// Where points lie on the device, and where their irradiance goes.
struct PointBuffers {
    /// `stride` vec4s per point. The first holds its position [m], the second its unit normal on
    /// the side that is lit; their fourth components are not read. With a stride of 1, the fourth
    /// component has the bits of packOctWord() of the normal.
    VkBuffer points = VK_NULL_HANDLE;
    std::uint32_t stride = 2;
    std::uint32_t together = 1; ///< so many points that follow each other have one irradiance
    VkBuffer irradiance = VK_NULL_HANDLE; ///< a vec4 each, the points' mean, RGB and 0 [W m^-2]
    std::uint32_t count = 0;              ///< of irradiances
};

/// Computes the irradiance of surface points from lights with their shadow maps, on the device that
/// drew them. What each light brings per unit of its colour and strength is kept, so that changing
/// these reads no shadow map. Not thread-safe.
class PointIrradiance {
public:
    /// The device and the buffers must outlive the object.
    PointIrradiance(gpu::Device& device, const PointBuffers& buffers);

    /// Brings the irradiance up to date with `lights`; a call with the version of the last one does
    /// nothing. Waits for the GPU; work submitted later sees the result after a barrier. Returns
    /// whether it was computed.
    bool update(const ShadowedLights& lights);

    /// The same as a part of the caller's work: isCurrent() says whether update() would do nothing,
    /// record() does what it would do, and finish() reads the time once that has completed.
    bool isCurrent(const ShadowedLights& lights) const { return m_version == lights.version; }
    void record(VkCommandBuffer cmd, const ShadowedLights& lights);
    void finish() { ms = m_times.steps()[0]; }

    /// Whatever wrote into the irradiance in between: the next update() computes it again.
    void forget() { m_version.reset(); }

    /// The points have moved: the next update() computes what every light brings to them.
    void pointsChanged();

    std::uint32_t lightsComputed = 0; ///< by the last update(), those without a place among them;
                                      ///< 0 where it did nothing
    double ms = 0;                    ///< GPU time of the last update()
    std::uint64_t dispatches = 0;     ///< so far
    VkDeviceSize bytes() const;       ///< of what is kept for the lights

private:
    void dispatchLights(VkCommandBuffer cmd, const ShadowedLights& lights);

    gpu::Device& m_device;
    PointBuffers m_buffers;
    KeptLights m_kept;
    std::optional<std::uint64_t> m_version; ///< of the lights
    gpu::DescriptorSetLayout m_setLayout;
    gpu::DescriptorPool m_pool;
    VkDescriptorSet m_set = VK_NULL_HANDLE;
    gpu::PipelineLayout m_layout;
    gpu::Pipeline m_pipeline;
    gpu::Timestamps m_times;
};

} // namespace limn
