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
    VK_FORMAT_R32G32B32A32_SFLOAT; ///< half floats overflow at lights of 1e6 cd
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;             ///< 1 near, 0 far
constexpr VkFormat kSurfaceFormat = VK_FORMAT_R32G32B32A32_UINT;    ///< packed by surface_pack.glsl
constexpr VkFormat kReceiverFormat = VK_FORMAT_R32G32B32A32_SFLOAT; ///< see surface_pack.glsl

/// Whether a view needs the direct pass.
constexpr bool showsDirectLight(View view) {
    return view == View::Lit || view == View::Direct;
}

/// The view that the camera's passes draw.
struct GeometryView {
    View view = View::Lit;
    glm::mat4 toClip{1};
    glm::vec3 eye{0};
    bool grid = false;           ///< instances without lightmap read the grid
    std::uint32_t bands = 3;     ///< bands of the indirect light
    bool reflectedApart = false; ///< what glossy receivers reflect is drawn by a LightPass
    bool throughGlass = false;   ///< leaves out surfaces that transmit light
    bool operator==(const GeometryView&) const = default;
};

/// Whether `view` may show a surface that transmits light.
bool showsGlass(const RenderScene& scene, const MaterialSet& materials, const GeometryView& view);

/// How the surfaces that were drawn read bounced light.
struct SurfacesDrawn {
    std::array<bool, kMaxBands + 1> bands{}; ///< bands[n]: some surface reads n bands
    std::uint32_t features = 0; ///< FEATURE_LIGHTMAP, FEATURE_GRID and FEATURE_REFLECTED_APART, if
                                ///< any surface reads them
};

/// Selects geometry inside `toClip` and no further than `reach` from `eye` [m].
struct DepthView {
    glm::mat4 toClip{1};
    glm::vec3 eye{0};
    float reach = 0;
};

/// Pipelines that draw a RenderScene: depth only (shadow maps) and surfaces. Variants are created
/// when first needed, so that a surface pays only for the textures it has.
class GeometryPasses {
public:
    GeometryPasses(gpu::Device& device, VkDescriptorSetLayout frameLayout,
                   VkDescriptorSetLayout materialLayout);

    VkPipelineLayout layout() const { return m_layout.handle; }

    /// Draws everything that `view` selects into the bound depth attachment, front and back faces
    /// alike.
    void drawDepth(VkCommandBuffer cmd, const RenderScene& scene, const MaterialSet& materials,
                   const DepthView& view, std::uint32_t slot);

    /// Depth pre-pass: draws the opaque surfaces of drawSurfaces() into the bound depth attachment,
    /// moved slightly away from the eye. drawSurfaces() then shades few hidden fragments, and the
    /// picture is unchanged.
    void drawDepthAhead(VkCommandBuffer cmd, const RenderScene& scene, const MaterialSet& materials,
                        const GeometryView& view);

    /// Draws surfaces into the bound images of SurfaceImages, nearest instances first. The back of
    /// a one-sided surface is black and hides what is behind it, as in path tracing. Descriptor set
    /// 0 must be bound; `slot` is that of MaterialSet.
    SurfacesDrawn drawSurfaces(VkCommandBuffer cmd, const RenderScene& scene,
                               const MaterialSet& materials, const GeometryView& view,
                               std::uint32_t slot);

private:
    /// What a surface pipeline depends on.
    struct Variant {
        View view;
        std::uint32_t features, bands;
        auto operator<=>(const Variant&) const = default;
    };

    void orderByDistance(const RenderScene& scene, const MaterialSet& materials,
                         const GeometryView& view);
    gpu::Pipeline createSurface(const Variant& variant);
    gpu::Pipeline createDepth(std::uint32_t features);

    gpu::Device& m_device;
    gpu::PipelineLayout m_layout;
    std::map<Variant, gpu::Pipeline> m_surface;
    std::map<std::uint32_t, gpu::Pipeline>
        m_depth; ///< keyed by FEATURE_BASE_COLOR_TEXTURE and FEATURE_ALPHA_MASK
    std::vector<std::pair<float, std::uint32_t>>
        m_order; ///< (distance, instance); kept to reuse its allocation
};

} // namespace limn::render
