// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/render/shadows/shadow_maps.h"

#include <vector>

namespace limn::render {

/// The lights that shine and their shadow views, as shaders read them. Mapped buffers that only
/// grow; a replaced one is retired.
struct LightTable {
    gpu::Buffer lights;                ///< shared::GpuLight each
    gpu::Buffer shadowViews;           ///< shared::GpuShadowView each
    std::uint32_t count = 0;           ///< lights
    std::vector<std::uint64_t> shapes; ///< as ShadowedLights::shapes
};

/// `slots`: one per light, as ShadowMaps::assign() gave them out, without which a light is left
/// out; `views`: ShadowMaps::views(). Nothing that reads the table may be in flight.
void writeLightTable(gpu::Device& device, LightTable& table, const std::vector<Light>& lights,
                     const std::vector<ShadowSlot>& slots,
                     const std::vector<shared::GpuShadowView>& views);

} // namespace limn::render
