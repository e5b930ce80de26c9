// SPDX-License-Identifier: MIT
#include "app/editor/ui_renderer.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/vulkan_error.h"

#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include <algorithm>

#include <glm/common.hpp>

namespace limn {

static VkRenderPass createRenderPass(gpu::Device& device, VkFormat format) {
    const VkAttachmentDescription attachment{
        .format = format,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD, // the picture is already there
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
        .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
        .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
        .initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
    };
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass{
        .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
        .colorAttachmentCount = 1,
        .pColorAttachments = &color,
    };
    const VkRenderPassCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
        .attachmentCount = 1,
        .pAttachments = &attachment,
        .subpassCount = 1,
        .pSubpasses = &subpass,
    };
    VkRenderPass pass = VK_NULL_HANDLE;
    VK_CHECK(vkCreateRenderPass(device.device, &info, nullptr, &pass));
    return pass;
}

static VkDescriptorPool createPool(gpu::Device& device) {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4};
    const VkDescriptorPoolCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT,
        .maxSets = 4,
        .poolSizeCount = 1,
        .pPoolSizes = &size,
    };
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VK_CHECK(vkCreateDescriptorPool(device.device, &info, nullptr, &pool));
    return pool;
}

static void checkResult(VkResult result) {
    gpu::check(result, "ImGui's Vulkan backend");
}

UiRenderer::UiRenderer(gpu::Device& device, const gpu::Swapchain& swapchain)
    : m_device(device), m_swapchain(swapchain),
      m_renderPass(createRenderPass(device, swapchain.format)), m_pool(device, createPool(device)) {
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = device.instance;
    info.PhysicalDevice = device.physicalDevice;
    info.Device = device.device;
    info.QueueFamily = device.queueFamily;
    info.Queue = device.queue;
    info.DescriptorPool = m_pool.handle;
    info.MinImageCount = 2;
    info.ImageCount = std::max(2u, gpu::Swapchain::kFramesInFlight + 1); // vertex buffers it keeps
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.CheckVkResultFn = checkResult;
    ImGui_ImplVulkan_Init(&info, m_renderPass);
    device.immediate("fonts",
                     [](VkCommandBuffer cmd) { ImGui_ImplVulkan_CreateFontsTexture(cmd); });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
    resized();
}

UiRenderer::~UiRenderer() {
    m_device.waitIdle(); // ImGui's backend destroys at once
    ImGui_ImplVulkan_Shutdown();
    retireFramebuffers();
    m_device.retire([device = m_device.device, pass = m_renderPass] {
        vkDestroyRenderPass(device, pass, nullptr);
    });
}

void UiRenderer::retireFramebuffers() {
    m_device.retire([device = m_device.device, old = std::move(m_framebuffers)] {
        for (VkFramebuffer framebuffer : old)
            vkDestroyFramebuffer(device, framebuffer, nullptr);
    });
    m_framebuffers.clear();
}

void UiRenderer::resized() {
    retireFramebuffers();
    for (const VkImageView& view : m_swapchain.views) {
        const VkFramebufferCreateInfo info{
            .sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
            .renderPass = m_renderPass,
            .attachmentCount = 1,
            .pAttachments = &view,
            .width = m_swapchain.width,
            .height = m_swapchain.height,
            .layers = 1,
        };
        VkFramebuffer framebuffer = VK_NULL_HANDLE;
        VK_CHECK(vkCreateFramebuffer(m_device.device, &info, nullptr, &framebuffer));
        m_framebuffers.push_back(framebuffer);
    }
}

static void blitPicture(VkCommandBuffer cmd, VkImage target, glm::ivec2 limit,
                        const WindowPicture& picture) {
    const glm::ivec2 begin = glm::clamp(picture.begin, glm::ivec2(0), limit);
    const glm::ivec2 end = glm::clamp(picture.end, glm::ivec2(0), limit);
    if (!picture.image || begin.x >= end.x || begin.y >= end.y)
        return;
    gpu::imageBarrier(cmd, picture.image, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kFragmentRead,
                      gpu::kTransferRead);
    const VkImageSubresourceLayers layers{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    const VkImageBlit region{
        .srcSubresource = layers,
        .srcOffsets = {{0, 0, 0}, {int(picture.size.x), int(picture.size.y), 1}},
        .dstSubresource = layers,
        .dstOffsets = {{begin.x, begin.y, 0}, {end.x, end.y, 1}},
    };
    const bool same = end - begin == glm::ivec2(picture.size);
    vkCmdBlitImage(cmd, picture.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region,
                   same ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
    gpu::imageBarrier(cmd, picture.image, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kTransferRead,
                      gpu::kFragmentRead);
}

void UiRenderer::record(VkCommandBuffer cmd, std::uint32_t index, const WindowPicture& picture) {
    const VkImage image = m_swapchain.images[index];
    // The transfer stage waits for the image to be released by the screen.
    const gpu::Access fresh{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_NONE,
                            VK_IMAGE_LAYOUT_UNDEFINED};
    gpu::imageBarrier(cmd, image, VK_IMAGE_ASPECT_COLOR_BIT, fresh, gpu::kTransferWrite);
    const VkClearColorValue clear{.float32 = {0.08f, 0.08f, 0.085f, 1}};
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(cmd, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &clear, 1, &all);
    gpu::imageBarrier(cmd, image, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kTransferWrite,
                      gpu::kTransferWrite);
    blitPicture(cmd, image, {int(m_swapchain.width), int(m_swapchain.height)}, picture);
    gpu::imageBarrier(cmd, image, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kTransferWrite, gpu::kColorWrite);
    const VkRenderPassBeginInfo begin{
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
        .renderPass = m_renderPass,
        .framebuffer = m_framebuffers[index],
        .renderArea = {{0, 0}, {m_swapchain.width, m_swapchain.height}},
    };
    vkCmdBeginRenderPass(cmd, &begin, VK_SUBPASS_CONTENTS_INLINE);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), cmd);
    vkCmdEndRenderPass(cmd);
    gpu::imageBarrier(cmd, image, VK_IMAGE_ASPECT_COLOR_BIT, gpu::kColorWrite, gpu::kPresent);
}

} // namespace limn
