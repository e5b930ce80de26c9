// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/descriptors.h"
#include "engine/gpu/pipeline.h"
#include "engine/scene/view.h"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <vulkan/vulkan.h>

namespace limn {

/// What a light pass is recorded for.
struct LightPassFrame {
    VkCommandBuffer cmd = VK_NULL_HANDLE;
    /// Set 0 of the pass: shaders/shared/light_pass.glsl reads it.
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
    /// LightPassSet::draw(). Whatever it reads was written by work that was submitted before.
    virtual void record(const LightPassFrame& frame) = 0;

    /// Whether the pass draws what glossy surfaces (engine/scene/surface/receiver_bands.h) reflect,
    /// in place of the lobes of the field's harmonics.
    virtual bool reflects() const { return false; }

    /// Device memory that the pass reads [bytes].
    virtual std::uint64_t bytes() const = 0;
};

/// A fragment shader that runs once for each pixel and adds what it writes to the linear picture.
/// It includes shaders/shared/light_pass.glsl.
struct LightPassShader {
    gpu::Spirv fragment;
    std::span<const VkDescriptorType> bindings; ///< of set 1: buffers, from binding 0 on
    std::vector<std::uint32_t> constants;       ///< specialisation constants from constant_id 2 on
    const char* name;
};

/// The pipelines of such a shader, made when first needed.
class LightPipelines {
public:
    /// What the arguments refer to outlives the object.
    LightPipelines(gpu::Device& device, VkDescriptorSetLayout frameLayout, LightPassShader shader);

    const LightPassShader& shader() const { return m_shader; }
    const gpu::DescriptorSetLayout& setLayout() const { return m_setLayout; }

    /// Binds the frame's set and `set` as set 1, and draws.
    void draw(const LightPassFrame& frame, VkDescriptorSet set);

private:
    gpu::Device& m_device;
    LightPassShader m_shader;
    gpu::DescriptorSetLayout m_setLayout;
    gpu::PipelineLayout m_layout;
    std::map<std::pair<View, bool>, gpu::Pipeline> m_pipelines; ///< by view and `diffuse`
};

/// Pipelines of all shaders that light passes of a viewport have used. New light of a technique
/// then needs buffers and a descriptor set, and no new pipeline.
class LightPipelineCache {
public:
    LightPipelineCache(gpu::Device& device, VkDescriptorSetLayout frameLayout)
        : m_device(device), m_frameLayout(frameLayout) {}

    /// The pipelines of the shader, the same for equal constants. Never null.
    std::shared_ptr<LightPipelines> of(const LightPassShader& shader);

private:
    gpu::Device& m_device;
    VkDescriptorSetLayout m_frameLayout;
    std::vector<std::shared_ptr<LightPipelines>> m_kept;
};

/// Set 1 of a pass.
class LightPassSet {
public:
    LightPassSet(gpu::Device& device, std::shared_ptr<LightPipelines> pipelines);

    /// No frame in flight may draw with the set.
    void bind(std::uint32_t binding, const gpu::Buffer& buffer);
    /// Draws with all bindings bound.
    void draw(const LightPassFrame& frame) const { m_pipelines->draw(frame, m_set); }

private:
    gpu::Device& m_device;
    std::shared_ptr<LightPipelines> m_pipelines;
    gpu::DescriptorPool m_pool;
    VkDescriptorSet m_set = VK_NULL_HANDLE;
};

} // namespace limn
