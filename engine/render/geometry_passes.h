// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/pipeline.h"
#include "engine/render/material_set.h"
#include "engine/render/render_scene.h"
#include "engine/scene/view.h"

#include <map>
#include <utility>

namespace limn::render {

constexpr VkFormat kLinearFormat =
    VK_FORMAT_R32G32B32A32_SFLOAT;                      ///< lights of 1e6 cd overflow halfs
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT; ///< 1 near, 0 far
constexpr VkFormat kSurfaceFormat = VK_FORMAT_R32G32B32A32_UINT; ///< surface_pack.glsl

/// Whether a view needs the surface image, and the direct pass after the shaded one.
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
    bool cullBackFaces = true;
    std::uint32_t slot = 0;
};

/// What is inside `toClip` and no further than `reach` from `eye` [m].
struct DepthView {
    glm::mat4 toClip{1};
    glm::vec3 eye{0};
    float reach = 0;
};

/// Pipelines that draw a RenderScene: depth only (shadow maps) and shaded. Variants are made when
/// first needed, so that a surface pays only for the textures and the kind of indirect light it
/// has.
class GeometryPasses {
public:
    GeometryPasses(gpu::Device& device, VkDescriptorSetLayout frameLayout,
                   VkDescriptorSetLayout materialLayout);

    VkPipelineLayout layout() const { return m_layout.handle; }

    /// Everything that `view` shows, no culling of faces, into a bound depth attachment.
    void drawDepth(VkCommandBuffer cmd, const RenderScene& scene, const MaterialSet& materials,
                   const DepthView& view, std::uint32_t slot);

    /// What drawShaded() will draw of opaque materials, a little further off, into a bound depth
    /// attachment: then it shades little that something else hides, and the picture is the same.
    void drawDepthAhead(VkCommandBuffer cmd, const RenderScene& scene, const MaterialSet& materials,
                        const GeometryView& view);

    /// Shaded but for direct light, into bound colour and depth attachments, nearest instances
    /// first. Set 0 is bound. Views that show direct light have a second colour attachment: the
    /// surface, for DirectPass.
    void drawShaded(VkCommandBuffer cmd, const RenderScene& scene, const MaterialSet& materials,
                    const GeometryView& view);

private:
    /// What a variant of shading depends on.
    struct Variant {
        View view;
        std::uint32_t features, bands;
        auto operator<=>(const Variant&) const = default;
    };

    gpu::Pipeline createShaded(const Variant& variant);
    gpu::Pipeline createDepth(std::uint32_t features);

    gpu::Device& m_device;
    gpu::PipelineLayout m_layout;
    std::map<Variant, gpu::Pipeline> m_shaded;
    std::map<std::uint32_t, gpu::Pipeline>
        m_depth; ///< by FEATURE_BASE_COLOR_TEXTURE and FEATURE_ALPHA_MASK
    std::vector<std::pair<float, std::uint32_t>>
        m_order; ///< distance, instance; kept to save its allocation
};

} // namespace limn::render
