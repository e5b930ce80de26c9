// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/render/light_pass.h"
#include "engine/render/viewport.h"
#include "engine/techniques/radiance_volumes/cache_grids.h"
#include "engine/techniques/radiance_volumes/glossy_map.h"
#include "engine/techniques/radiance_volumes/volume_part.h"
#include "shaders/shared/gpu_volumes.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace limn {

/// Caches and their light on a device. Empty buffers: there are none.
struct GpuVolume {
    shared::GpuCacheGrids grids{};
    std::uint32_t bands = 2;
    std::shared_ptr<const gpu::Buffer> address; ///< uint for each node of each grid; may be null
    gpu::Buffer harmonics;                      ///< CacheLight::harmonics
    gpu::Buffer glossy;                         ///< CacheLight::glossy
    std::uint64_t bytes() const {
        return (address ? address->size : 0) + harmonics.size + glossy.size;
    }
};

/// The grids as shaders read them. `glossy`: shape of the maps for reflections, for `eye`.
shared::GpuCacheGrids gpuCacheGrids(const CacheGrids& grids,
                                    const std::optional<GlossyMapShape>& glossy, glm::vec3 eye);

/// Draws the light of caches.
class VolumePass : public LightPass {
public:
    /// `volume` must not be null. Device and viewport outlive the object.
    VolumePass(gpu::Device& device, Viewport& viewport, std::shared_ptr<const GpuVolume> volume);

    void record(const LightPassFrame& frame) override;
    std::uint64_t bytes() const override { return m_volume->bytes() + m_grids.size; }

private:
    std::shared_ptr<const GpuVolume> m_volume;
    gpu::Buffer m_grids;
    LightPassSet m_set;
};

/// The pass for a field with a VolumePart, which it uploads. Null where nothing is lit.
std::shared_ptr<LightPass> uploadVolumePart(gpu::Device& device, Viewport& viewport,
                                            const IndirectField& field);

} // namespace limn
