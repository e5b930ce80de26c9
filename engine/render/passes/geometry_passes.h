// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/pipeline.h"
#include "engine/math/sh.h"
#include "engine/render/surfaces/material_set.h"
#include "engine/render/surfaces/render_scene.h"
#include "engine/scene/view.h"

#include <array>
#include <map>
#include <utility>

namespace limn::render {

constexpr VkFormat kLinearFormat =
    VK_FORMAT_R32G32B32A32_SFLOAT;                      ///< lights of 1e6 cd overflow halfs
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT; ///< 1 near, 0 far
constexpr VkFormat kSurfaceFormat = VK_FORMAT_R32G32B32A32_UINT;    ///< surface_pack.glsl
constexpr VkFormat kReceiverFormat = VK_FORMAT_R32G32B32A32_SFLOAT; ///< the same

/// Whether a view needs the direct pass.
constexpr bool showsDirectLight(View view) {
    return view == View::Lit || view == View::Direct;
}

/// What the camera's passes need to know.
struct GeometryView {
    View view = View::Lit;
    glm::mat4 toClip{1};
    glm::vec3 eye{0};
    bool grid = false;       ///< instances without lightmap read the grid
    std::uint32_t bands = 3; ///< of the indirect light
    bool operator==(const GeometryView&) const = default;
};

/// How the surfaces that were drawn read bounced light.
struct SurfacesDrawn {
    std::array<bool, kMaxBands + 1> bands{}; ///< any reads so many
    std::uint32_t features = 0;              ///< FEATURE_LIGHTMAP, FEATURE_GRID: any does
};

/// What is inside `toClip` and no further than `reach` from `eye` [m].
struct DepthView {
    glm::mat4 toClip{1};
    glm::vec3 eye{0};
    float reach = 0;
};

/// Pipelines that draw a RenderScene: depth only (shadow maps) and surfaces. Variants are made when
/// first needed, so that a surface pays only for the textures it has.
class GeometryPasses {
public:
    GeometryPasses(gpu::Device& device, VkDescriptorSetLayout frameLayout,
                   VkDescriptorSetLayout materialLayout);

    VkPipelineLayout layout() const { return m_layout.handle; }

    /// Everything that `view` shows, whichever side it looks from, into a bound depth attachment.
    void drawDepth(VkCommandBuffer cmd, const RenderScene& scene, const MaterialSet& materials,
                   const DepthView& view, std::uint32_t slot);

    /// What drawSurfaces() will draw of opaque materials, a little further off, into a bound depth
    /// attachment: then it shades little that something else hides, and the picture is the same.
    void drawDepthAhead(VkCommandBuffer cmd, const RenderScene& scene, const MaterialSet& materials,
                        const GeometryView& view);

    /// What SurfaceImages keeps of surfaces, into its bound images, nearest instances first. The
    /// back of a one-sided surface is black and hides what is behind it, as paths see it. Set 0 is
    /// bound; `slot` as in MaterialSet.
    SurfacesDrawn drawSurfaces(VkCommandBuffer cmd, const RenderScene& scene,
                               const MaterialSet& materials, const GeometryView& view,
                               std::uint32_t slot);

private:
    /// What a surface's variant depends on.
    struct Variant {
        View view;
        std::uint32_t features, bands;
        auto operator<=>(const Variant&) const = default;
    };

    gpu::Pipeline createSurface(const Variant& variant);
    gpu::Pipeline createDepth(std::uint32_t features);

    gpu::Device& m_device;
    gpu::PipelineLayout m_layout;
    std::map<Variant, gpu::Pipeline> m_surface;
    std::map<std::uint32_t, gpu::Pipeline>
        m_depth; ///< by FEATURE_BASE_COLOR_TEXTURE and FEATURE_ALPHA_MASK
    std::vector<std::pair<float, std::uint32_t>>
        m_order; ///< distance, instance; kept to save its allocation
};

} // namespace limn::render
