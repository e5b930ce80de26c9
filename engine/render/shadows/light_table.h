// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/render/shadows/shadow_maps.h"

#include <vector>

namespace limn::render {

/// The lights that shine and their shadow views, as shaders read them. Mapped buffers that only
/// grow; a replaced one is retired.
struct LightTable {
    gpu::Buffer lights;                ///< array of shared::GpuLight, then values of profiles
    gpu::Buffer shadowViews;           ///< array of shared::GpuShadowView
    std::uint32_t count = 0;           ///< lights
    std::vector<std::uint64_t> shapes; ///< as ShadowedLights::shapes
};

/// Writes `lights` into the table. `slots` has one entry per light as returned by
/// ShadowMaps::assign(); lights with an empty slot are left out. `views` is ShadowMaps::views(). No
/// GPU work that reads the table may be in flight.
void writeLightTable(gpu::Device& device, LightTable& table, const std::vector<Light>& lights,
                     const std::vector<ShadowSlot>& slots,
                     const std::vector<shared::GpuShadowView>& views);

} // namespace limn::render
