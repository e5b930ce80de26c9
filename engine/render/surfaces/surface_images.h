// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/image.h"
#include "engine/render/passes/geometry_passes.h"
#include "engine/render/passes/rendering.h"

#include <cstdint>

namespace limn::render {

/// What the camera sees, one surface a pixel: all that shading reads besides the light. Drawn only
/// when it changed, so that moving light pays for no triangle.
class SurfaceImages {
public:
    explicit SurfaceImages(gpu::Device& device) : m_device(device) {}

    /// Sizes only grow.
    void ensure(Extent size);

    /// Draws what `view` sees unless the images hold just that; `scene` and `materials` are known
    /// by their versions. Afterwards fragment shaders may read the images. True if it drew.
    bool record(VkCommandBuffer cmd, GeometryPasses& geometry, const RenderScene& scene,
                const MaterialSet& materials, const GeometryView& view, Extent size,
                std::uint32_t slot, VkDescriptorSet frameSet);

    /// Others have drawn into the depths, so they are to be drawn anew.
    void forget() { m_holds = {}; }

    /// How the surfaces in them read bounced light.
    const SurfacesDrawn& drawn() const { return m_drawn; }

    gpu::Image depth;    ///< kDepthFormat, 0 where there is no surface
    gpu::Image surface;  ///< kSurfaceFormat
    gpu::Image emitted;  ///< kLinearFormat, as surface.frag says
    gpu::Image receiver; ///< kReceiverFormat

private:
    struct Contents {
        GeometryView view;
        Extent size; ///< 0: nothing
        std::uint64_t scene = 0, materials = 0;
        bool operator==(const Contents&) const = default;
    };

    gpu::Device& m_device;
    Contents m_holds;
    SurfacesDrawn m_drawn;
};

} // namespace limn::render
