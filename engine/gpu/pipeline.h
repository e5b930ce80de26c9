// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/handle.h"

#include <cstddef>
#include <span>
#include <vector>

namespace limn::gpu {

/// SPIR-V words, as the build embeds them.
using Spirv = std::span<const std::uint32_t>;

PipelineLayout createPipelineLayout(Device& device,
                                    std::span<const VkDescriptorSetLayout> setLayouts,
                                    std::uint32_t pushConstantBytes, const char* name);

/// What becomes of the colour that is there.
enum class Blend {
    Replace,
    Add, ///< the new one is added
    Mix, ///< the two are mixed by the alpha of the new one
};

struct GraphicsPipelineDesc {
    Spirv vertex;
    Spirv fragment; ///< empty: depth only
    VkPipelineLayout layout = VK_NULL_HANDLE;
    std::vector<VkVertexInputBindingDescription> bindings;
    std::vector<VkVertexInputAttributeDescription> attributes;
    std::vector<VkFormat> colorFormats;
    VkFormat depthFormat = VK_FORMAT_UNDEFINED; ///< UNDEFINED: no depth test
    VkCompareOp depthCompare = VK_COMPARE_OP_LESS;
    bool depthWrite = true;
    Blend blend = Blend::Replace;
    bool depthBias = false; ///< set with vkCmdSetDepthBias
    bool wireframe = false; ///< draws the triangles' edges; needs Device::wireframe
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    /// If true, the front face is set with vkCmdSetFrontFace; otherwise counter-clockwise on screen
    /// is the front. No face is culled.
    bool dynamicFrontFace = false;
    /// Specialisation constants: word i is constant_id i of both stages.
    std::vector<std::uint32_t> constants;
    const char* name = "";
};

/// Viewport, scissor and, if the desc says so, depth bias are dynamic.
Pipeline createGraphicsPipeline(Device& device, const GraphicsPipelineDesc& desc);

Pipeline createComputePipeline(Device& device, Spirv shader, VkPipelineLayout layout,
                               std::span<const std::uint32_t> constants, const char* name);

/// Workgroups of `lanes` invocations that together have one for each item.
constexpr std::uint32_t groups(std::uint32_t items, std::uint32_t lanes) {
    return (items + lanes - 1) / lanes;
}

/// Records a dispatch of `groups` workgroups in rows, as shaders/shared/compute_groups.glsl counts
/// them, and a barrier that makes what it wrote visible to the next. `set` is set 0. Returns the
/// number of dispatches: 0 for no groups.
std::uint32_t dispatch(Device& device, VkCommandBuffer cmd, VkPipeline pipeline,
                       VkPipelineLayout layout, VkDescriptorSet set,
                       std::span<const std::byte> pushConstants, std::size_t groups);

} // namespace limn::gpu
