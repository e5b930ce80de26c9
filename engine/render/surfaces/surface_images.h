// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/image.h"
#include "engine/render/passes/geometry_passes.h"
#include "engine/render/passes/rendering.h"

#include <cstdint>

namespace limn::render {

/// The surface seen in each pixel: all that shading reads besides the light. Redrawn only when it
/// changed, so that moving lights cause no triangles to be drawn.
class SurfaceImages {
public:
    explicit SurfaceImages(gpu::Device& device) : m_device(device) {}

    /// Makes the images at least this large. They never shrink.
    void ensure(Extent size);

    /// Draws what `view` sees unless the images already hold it; `scene` and `materials` are
    /// compared by version. Afterwards fragment shaders may read the images. Returns true if it
    /// drew.
    bool record(VkCommandBuffer cmd, GeometryPasses& geometry, const RenderScene& scene,
                const MaterialSet& materials, const GeometryView& view, Extent size,
                std::uint32_t slot, VkDescriptorSet frameSet);

    /// Invalidates the images. Call after other passes have drawn into the depth image.
    void forget() { m_holds = {}; }

    /// How the surfaces in the images read bounced light.
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
