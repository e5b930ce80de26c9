// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/passes/geometry_passes.h"

#include <compare>
#include <map>

namespace limn::render {

/// Writes the linear image: emission and reflected bounced light of surfaces, or the background.
class IndirectPass {
public:
    IndirectPass(gpu::Device& device, VkDescriptorSetLayout frameLayout);

    /// Records the pass over the whole bound linear image. `frameSet` holds the surface images and
    /// the field, whose first `chroma` bands are in colour. `diffuse`: as
    /// ViewportOptions::diffuse.
    void record(VkCommandBuffer cmd, VkDescriptorSet frameSet, View view, bool diffuse,
                const SurfacesDrawn& surfaces, std::uint32_t chroma);

private:
    struct Variant {
        View view;
        std::uint32_t features, bands, chroma;
        bool first, diffuse;
        auto operator<=>(const Variant&) const = default;
    };

    VkPipeline pipeline(const Variant& variant);

    gpu::Device& m_device;
    gpu::PipelineLayout m_layout;
    std::map<Variant, gpu::Pipeline> m_pipelines;
};

} // namespace limn::render
