// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/pipeline.h"
#include "engine/render/near/near_surfaces.h"
#include "engine/render/surfaces/slot_texture.h"
#include "engine/render/viewport.h"

#include <compare>
#include <map>
#include <memory>

namespace limn::render {

/// Adds nearCorrection() of engine/picture/near_light.h to the bounced light in the linear image.
/// Reads the shadow maps of all lights.
class NearPass {
public:
    NearPass(gpu::Device& device, VkDescriptorSetLayout frameLayout);

    /// Takes note of the scene, if `version` is not that of the last call.
    void set(const Scene& scene, std::shared_ptr<const LightmapLayout> layout,
             std::uint64_t version);

    /// Uploads the surfaces if these options need them and they have changed. Returns active().
    bool prepare(const ViewportOptions& options);
    /// Whether record() is to be called: the options ask for near rays, the view shows bounced
    /// light, and there are surfaces that fit the device.
    bool active(const ViewportOptions& options) const;

    /// Binds the field to a slot of MaterialSet. No frame in flight may use it.
    void bind(const GpuField& field, std::uint32_t slot) {
        m_lightmap.with(field.lightmap.view, slot);
    }

    /// Records the pass over the whole bound linear image, for sample `sample` of each pixel.
    /// `frameSet` holds the surface images and the lights with their shadow maps, and `slot` was
    /// bound to `field`. Precondition: active().
    void record(VkCommandBuffer cmd, VkDescriptorSet frameSet, const ViewportOptions& options,
                const GpuField& field, std::uint32_t sample, std::uint32_t slot);

private:
    struct Variant {
        View view;
        std::uint32_t bands, chroma;
        auto operator<=>(const Variant&) const = default;
    };

    VkPipeline pipeline(const Variant& variant);

    gpu::Device& m_device;
    VkDescriptorSetLayout m_frameLayout;
    NearSurfaces m_surfaces;
    SlotTexture m_lightmap;
    gpu::PipelineLayout m_layout; ///< made when first needed
    std::map<Variant, gpu::Pipeline> m_pipelines;
};

} // namespace limn::render
