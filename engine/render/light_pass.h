// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/pipeline.h"
#include "engine/scene/view.h"

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <vulkan/vulkan.h>

namespace limn {

/// What a light pass is recorded for.
struct LightPassFrame {
    VkCommandBuffer cmd = VK_NULL_HANDLE;
    /// Set 0 of the pass, in Viewport::frameLayout(): shaders/shared/light_pass.glsl reads it.
    VkDescriptorSet frame = VK_NULL_HANDLE;
    View view = View::Lit; ///< one that shows bounced light
    bool diffuse = true;   ///< as ViewportOptions::diffuse
};

/// The pass by which a technique adds light of its own kind, which is neither in a lightmap nor in
/// a grid, to the surfaces that a viewport draws. What it binds beside the frame is the technique's
/// matter: up to five storage buffers on every device, since the frame has three.
class LightPass {
public:
    virtual ~LightPass() = default;

    /// Records what adds the bounced light to the picture, within a rendering that has begun:
    /// LightPipelines::draw() with the technique's sets bound. Whatever it reads was written by
    /// work that was submitted before.
    virtual void record(const LightPassFrame& frame) = 0;

    /// Whether the pass draws what glossy surfaces (engine/scene/surface/receiver_bands.h) reflect,
    /// in place of the lobes of the field's harmonics.
    virtual bool reflects() const { return false; }

    /// Device memory that the pass reads [bytes].
    virtual std::uint64_t bytes() const = 0;
};

/// Pipelines of a pass that runs a fragment shader once for each pixel and adds what it writes to
/// the linear picture. The shader includes shaders/shared/light_pass.glsl.
class LightPipelines {
public:
    /// `setLayouts`: those of set 1 and further ones. `constants`: specialisation constants from
    /// constant_id 2 on. The arguments outlive the object.
    LightPipelines(gpu::Device& device, VkDescriptorSetLayout frameLayout,
                   std::span<const VkDescriptorSetLayout> setLayouts, gpu::Spirv fragment,
                   std::vector<std::uint32_t> constants, const char* name);

    /// Binds the frame's set and `sets`, from set 1 on, and draws.
    void draw(const LightPassFrame& frame, std::span<const VkDescriptorSet> sets);

private:
    gpu::Device& m_device;
    gpu::Spirv m_fragment;
    std::vector<std::uint32_t> m_constants;
    const char* m_name;
    gpu::PipelineLayout m_layout;
    std::map<std::pair<View, bool>, gpu::Pipeline> m_pipelines; ///< made when first needed
};

} // namespace limn
