// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/descriptors.h"
#include "engine/render/surface_map.h"
#include "engine/rsm/reflective_shadow_map.h"
#include "shaders/shared/gpu_rsm.h"

#include <array>
#include <cstdint>
#include <vector>

namespace limn {

/// A view of a light's reflective shadow map, as Viewport::drawSurfaceMaps() draws it and
/// shaders/shared/rsm_texel.glsl reads it. Texels are those of castRsm(), but for rounding and for
/// the edges of triangles.
struct DrawnRsmView {
    RsmView view;               ///< `right` and `up` form a right-handed system with -forward
    SurfaceMapView drawn;       ///< the projection whose texels are those of the view
    shared::GpuRsmView shaders; ///< for the shaders that read its map
    std::uint32_t index = 0;    ///< of the view among those of rsmViews()
    bool turned = false;        ///< whether `right` and `up` are exchanged
};

/// The views of a light, as unitLight() makes it, over a scene with these bounds; all have the same
/// size. Views into which a light sends nothing are missing. `size`: as for castRsm().
std::vector<DrawnRsmView> drawnRsmViews(const Light& light, const Bounds& bounds,
                                        std::uint32_t size);

/// Types of the first bindings of set 0 of shaders that read maps.
inline constexpr std::array<VkDescriptorType, RSM_BINDINGS> kRsmTypes = {
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER};

/// Writes the images of a map into these bindings.
void writeRsmImages(gpu::Device& device, VkDescriptorSet set, const SurfaceMap& map);

} // namespace limn
