// SPDX-License-Identifier: MIT
#include "engine/gpu/pipeline.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/vulkan_error.h"

#include <array>

namespace limn::gpu {

PipelineLayout createPipelineLayout(Device& device,
                                    std::span<const VkDescriptorSetLayout> setLayouts,
                                    std::uint32_t pushConstantBytes, const char* name) {
    const VkPushConstantRange range{VK_SHADER_STAGE_ALL, 0, pushConstantBytes};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .pNext = nullptr,
                                          .flags = 0,
                                          .setLayoutCount = std::uint32_t(setLayouts.size()),
                                          .pSetLayouts = setLayouts.data(),
                                          .pushConstantRangeCount = pushConstantBytes ? 1u : 0u,
                                          .pPushConstantRanges = &range};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VK_CHECK(vkCreatePipelineLayout(device.device, &info, nullptr, &layout));
    device.setName(VK_OBJECT_TYPE_PIPELINE_LAYOUT, std::uint64_t(layout), name);
    return {device, layout};
}

namespace {

/// A shader module that exists only while a pipeline is created.
struct Module {
    Module(VkDevice owner, Spirv words) : device(owner) {
        const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                            .pNext = nullptr,
                                            .flags = 0,
                                            .codeSize = words.size_bytes(),
                                            .pCode = words.data()};
        VK_CHECK(vkCreateShaderModule(device, &info, nullptr, &handle));
    }
    ~Module() { vkDestroyShaderModule(device, handle, nullptr); }
    Module(const Module&) = delete;
    Module& operator=(const Module&) = delete;

    VkDevice device;
    VkShaderModule handle = VK_NULL_HANDLE;
};

/// Specialisation constants in order of id, kept alive while the pipeline is created.
struct Specialisation {
    explicit Specialisation(std::span<const std::uint32_t> words) {
        for (std::uint32_t i = 0; i < words.size(); ++i)
            entries.push_back({i, i * 4, 4});
        info = {std::uint32_t(entries.size()), entries.data(), words.size_bytes(), words.data()};
    }

    std::vector<VkSpecializationMapEntry> entries;
    VkSpecializationInfo info{};
};

} // namespace

static VkPipelineShaderStageCreateInfo stageInfo(VkShaderStageFlagBits stage, VkShaderModule module,
                                                 const Specialisation& specialisation) {
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
            .pNext = nullptr,
            .flags = 0,
            .stage = stage,
            .module = module,
            .pName = "main",
            .pSpecializationInfo = &specialisation.info};
}

// Adds the state that all pipelines share to the state given by `desc`.
static VkPipeline createWithStages(Device& device, const GraphicsPipelineDesc& desc,
                                   std::span<const VkPipelineShaderStageCreateInfo> stages) {
    VkPipelineVertexInputStateCreateInfo input{};
    input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    input.vertexBindingDescriptionCount = std::uint32_t(desc.bindings.size());
    input.pVertexBindingDescriptions = desc.bindings.data();
    input.vertexAttributeDescriptionCount = std::uint32_t(desc.attributes.size());
    input.pVertexAttributeDescriptions = desc.attributes.data();

    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = desc.topology;

    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = viewport.scissorCount = 1;

    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.cullMode = VK_CULL_MODE_NONE;
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.depthBiasEnable = desc.depthBias;
    raster.polygonMode = desc.wireframe ? VK_POLYGON_MODE_LINE : VK_POLYGON_MODE_FILL;
    raster.lineWidth = 1;

    VkPipelineMultisampleStateCreateInfo samples{};
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;

    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = desc.depthFormat != VK_FORMAT_UNDEFINED;
    depth.depthWriteEnable = depth.depthTestEnable && desc.depthWrite;
    depth.depthCompareOp = desc.depthCompare;

    VkPipelineColorBlendAttachmentState attachment{};
    attachment.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    if (desc.blend != Blend::Replace) {
        const bool mix = desc.blend == Blend::Mix;
        attachment.blendEnable = VK_TRUE;
        attachment.srcColorBlendFactor = attachment.srcAlphaBlendFactor =
            mix ? VK_BLEND_FACTOR_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
        attachment.dstColorBlendFactor = attachment.dstAlphaBlendFactor =
            mix ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
    }
    const std::vector attachments(desc.colorFormats.size(), attachment);
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = std::uint32_t(attachments.size());
    blend.pAttachments = attachments.data();

    std::vector<VkDynamicState> dynamics;
    dynamics.reserve(5); // without it GCC 12 sees an overflow where there is none
    dynamics.assign({VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR});
    if (desc.depthBias)
        dynamics.push_back(VK_DYNAMIC_STATE_DEPTH_BIAS);
    if (desc.dynamicFrontFace)
        dynamics.push_back(VK_DYNAMIC_STATE_FRONT_FACE);
    VkPipelineDynamicStateCreateInfo dynamic{};
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = std::uint32_t(dynamics.size());
    dynamic.pDynamicStates = dynamics.data();

    VkPipelineRenderingCreateInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.colorAttachmentCount = std::uint32_t(desc.colorFormats.size());
    rendering.pColorAttachmentFormats = desc.colorFormats.data();
    rendering.depthAttachmentFormat = desc.depthFormat;

    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.pNext = &rendering;
    info.stageCount = std::uint32_t(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = desc.layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VK_CHECK(
        vkCreateGraphicsPipelines(device.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline));
    return pipeline;
}

Pipeline createGraphicsPipeline(Device& device, const GraphicsPipelineDesc& desc) {
    const Specialisation specialisation(desc.constants);
    const Module vertex(device.device, desc.vertex);
    VkPipeline pipeline = VK_NULL_HANDLE;
    if (desc.fragment.empty()) {
        const std::array stages = {
            stageInfo(VK_SHADER_STAGE_VERTEX_BIT, vertex.handle, specialisation)};
        pipeline = createWithStages(device, desc, stages);
    } else {
        const Module fragment(device.device, desc.fragment);
        const std::array stages = {
            stageInfo(VK_SHADER_STAGE_VERTEX_BIT, vertex.handle, specialisation),
            stageInfo(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.handle, specialisation)};
        pipeline = createWithStages(device, desc, stages);
    }
    device.setName(VK_OBJECT_TYPE_PIPELINE, std::uint64_t(pipeline), desc.name);
    return {device, pipeline};
}

Pipeline createComputePipeline(Device& device, Spirv shader, VkPipelineLayout layout,
                               std::span<const std::uint32_t> constants, const char* name) {
    const Specialisation specialisation(constants);
    const Module module(device.device, shader);
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage = stageInfo(VK_SHADER_STAGE_COMPUTE_BIT, module.handle, specialisation);
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VK_CHECK(vkCreateComputePipelines(device.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline));
    device.setName(VK_OBJECT_TYPE_PIPELINE, std::uint64_t(pipeline), name);
    return {device, pipeline};
}

std::uint32_t dispatch(Device& device, VkCommandBuffer cmd, VkPipeline pipeline,
                       VkPipelineLayout layout, VkDescriptorSet set,
                       std::span<const std::byte> pushConstants, std::size_t groups) {
    if (groups == 0)
        return 0;
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    vkCmdPushConstants(cmd, layout, VK_SHADER_STAGE_ALL, 0, std::uint32_t(pushConstants.size()),
                       pushConstants.data());
    const std::size_t widest = device.properties.limits.maxComputeWorkGroupCount[0];
    const std::size_t rows = (groups + widest - 1) / widest;
    vkCmdDispatch(cmd, std::uint32_t((groups + rows - 1) / rows), std::uint32_t(rows), 1);
    memoryBarrier(cmd, kComputeWrite, kComputeWrite);
    return 1;
}

} // namespace limn::gpu
