// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/techniques/probes/marched_maps.h"

#include <cstdint>
#include <memory>
#include <span>

namespace limn {

/// MarchedMaps on the GPU, for shaders/probes/march_ray.glsl.
struct GpuMarchedMaps {
    std::uint32_t probes = 0, side = 0; ///< MarchedMaps::side
    gpu::Buffer planes;                 ///< MarchedMaps::planes, a vec4 each
    gpu::Buffer nearest;  ///< floats, 1 + nearestSide()^2 per probe: 1 if it is in a solid, else 0;
                          ///< MarchedMaps::nearest
    gpu::Buffer radiance; ///< three floats per texel: all probes' of level 0, then of level 1 ...

    VkDeviceSize bytes() const { return planes.size + nearest.size + radiance.size; }
};

/// Creates maps of an empty black scene, which shaders may write. Null if the device cannot bind
/// buffers as large as these. Throws VulkanError when out of memory.
std::shared_ptr<GpuMarchedMaps> createMarchedMaps(gpu::Device& device, std::uint32_t probes,
                                                  std::uint32_t side);

/// Copies planes, nearest distances and solids of some probes from `maps`, which has as many probes
/// of the same side. Work submitted before may read the old values.
void uploadMarchedPlanes(gpu::Device& device, const MarchedMaps& maps,
                         std::span<const std::uint32_t> probes, const GpuMarchedMaps& to);

/// Copies the radiance of all probes.
void uploadMarchedRadiance(gpu::Device& device, const MarchedMaps& maps, const GpuMarchedMaps& to);

} // namespace limn
