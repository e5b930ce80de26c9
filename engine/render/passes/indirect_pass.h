// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/descriptors.h"
#include "engine/render/gpu_field.h"
#include "engine/render/passes/geometry_passes.h"

#include <array>
#include <compare>
#include <map>

namespace limn::render {

/// Writes the linear image: emission and reflected bounced light of surfaces, or the background.
class IndirectPass {
public:
    IndirectPass(gpu::Device& device, VkDescriptorSetLayout frameLayout);

    /// Binds the field to the slot's set. No frame in flight may use the slot.
    void bind(const GpuField& field, std::uint32_t slot);

    /// Records the pass over the whole bound linear image with the field of the slot's bind().
    /// `frameSet` holds the surface images. `diffuse`: as ViewportOptions::diffuse.
    void record(VkCommandBuffer cmd, VkDescriptorSet frameSet, View view, bool diffuse,
                const SurfacesDrawn& surfaces, std::uint32_t slot);

private:
    struct Variant {
        View view;
        std::uint32_t features, bands, chroma;
        bool first, diffuse;
        auto operator<=>(const Variant&) const = default;
    };

    VkPipeline pipeline(const Variant& variant);

    gpu::Device& m_device;
    gpu::DescriptorSetLayout m_setLayout; ///< of the field
    gpu::DescriptorPool m_pool;
    gpu::Sampler m_sampler;
    std::array<VkDescriptorSet, kFrameSlots> m_sets{};
    std::array<std::uint32_t, kFrameSlots> m_chroma{}; ///< bands of the bound fields in colour
    gpu::PipelineLayout m_layout;
    std::map<Variant, gpu::Pipeline> m_pipelines;
};

} // namespace limn::render
