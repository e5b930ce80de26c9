// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/passes/geometry_passes.h"

#include <compare>
#include <map>

namespace limn::render {

/// Writes the linear image: what surfaces emit and the bounced light that they reflect, or the
/// background.
class IndirectPass {
public:
    IndirectPass(gpu::Device& device, VkDescriptorSetLayout frameLayout);

    /// Into all of the bound linear image; `frameSet` holds the surface's images and the
    /// field, which has so many bands in colour.
    void record(VkCommandBuffer cmd, VkDescriptorSet frameSet, View view,
                const SurfacesDrawn& surfaces, std::uint32_t chroma);

private:
    struct Variant {
        View view;
        std::uint32_t features, bands, chroma;
        bool first;
        auto operator<=>(const Variant&) const = default;
    };

    VkPipeline pipeline(const Variant& variant);

    gpu::Device& m_device;
    gpu::PipelineLayout m_layout;
    std::map<Variant, gpu::Pipeline> m_pipelines;
};

} // namespace limn::render
