// SPDX-License-Identifier: MIT
#include "engine/gpu/swapchain.h"

#include "engine/gpu/vulkan_error.h"

#include <algorithm>

namespace limn::gpu {

static VkSemaphore createSemaphore(Device& device) {
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    VK_CHECK(vkCreateSemaphore(device.device, &info, nullptr, &semaphore));
    return semaphore;
}

static VkSurfaceFormatKHR chooseFormat(const Device& device, VkSurfaceKHR surface) {
    std::uint32_t count = 0;
    VK_CHECK(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physicalDevice, surface, &count, nullptr));
    std::vector<VkSurfaceFormatKHR> formats(count);
    VK_CHECK(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physicalDevice, surface, &count,
                                                  formats.data()));
    for (VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM})
        for (const VkSurfaceFormatKHR& f : formats)
            if (f.format == wanted && f.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR)
                return f;
    throw VulkanError(VK_ERROR_FORMAT_NOT_SUPPORTED, "a window with 8-bit UNORM images");
}

/// Mailbox never makes acquire() wait for the screen; FIFO is always there.
static VkPresentModeKHR choosePresentMode(const Device& device, VkSurfaceKHR surface) {
    std::uint32_t count = 0;
    VK_CHECK(
        vkGetPhysicalDeviceSurfacePresentModesKHR(device.physicalDevice, surface, &count, nullptr));
    std::vector<VkPresentModeKHR> modes(count);
    VK_CHECK(vkGetPhysicalDeviceSurfacePresentModesKHR(device.physicalDevice, surface, &count,
                                                       modes.data()));
    const bool mailbox = std::ranges::find(modes, VK_PRESENT_MODE_MAILBOX_KHR) != modes.end();
    return mailbox ? VK_PRESENT_MODE_MAILBOX_KHR : VK_PRESENT_MODE_FIFO_KHR;
}

Swapchain::Swapchain(Device& device, VkSurfaceKHR surface) : m_device(device), m_surface(surface) {
    format = chooseFormat(device, surface).format;
    for (Semaphore& semaphore : m_acquired)
        semaphore = Semaphore(device, createSemaphore(device));
}

Swapchain::~Swapchain() {
    retireImages();
    m_device.retire([instance = m_device.instance, device = m_device.device,
                     swapchain = m_swapchain, surface = m_surface] {
        vkDestroySwapchainKHR(device, swapchain, nullptr);
        vkDestroySurfaceKHR(instance, surface, nullptr);
    });
}

void Swapchain::retireImages() {
    m_device.retire([device = m_device.device, oldViews = views, semaphores = m_drawn] {
        for (VkImageView view : oldViews)
            vkDestroyImageView(device, view, nullptr);
        for (VkSemaphore semaphore : semaphores)
            vkDestroySemaphore(device, semaphore, nullptr);
    });
    images.clear();
    views.clear();
    m_drawn.clear();
}

void Swapchain::createViews() {
    std::uint32_t count = 0;
    VK_CHECK(vkGetSwapchainImagesKHR(m_device.device, m_swapchain, &count, nullptr));
    images.resize(count);
    VK_CHECK(vkGetSwapchainImagesKHR(m_device.device, m_swapchain, &count, images.data()));
    for (VkImage image : images) {
        const VkImageViewCreateInfo info{
            .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
            .image = image,
            .viewType = VK_IMAGE_VIEW_TYPE_2D,
            .format = format,
            .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1},
        };
        VkImageView view = VK_NULL_HANDLE;
        VK_CHECK(vkCreateImageView(m_device.device, &info, nullptr, &view));
        views.push_back(view);
        m_drawn.push_back(createSemaphore(m_device));
    }
}

bool Swapchain::resize(std::uint32_t newWidth, std::uint32_t newHeight) {
    VkSurfaceCapabilitiesKHR caps;
    VK_CHECK(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(m_device.physicalDevice, m_surface, &caps));
    const bool fixed = caps.currentExtent.width != ~0u;
    width = fixed ? caps.currentExtent.width
                  : std::clamp(newWidth, caps.minImageExtent.width, caps.maxImageExtent.width);
    height = fixed ? caps.currentExtent.height
                   : std::clamp(newHeight, caps.minImageExtent.height, caps.maxImageExtent.height);
    m_outdated = width == 0 || height == 0;
    if (m_outdated)
        return false;
    // Presented images may still wait for their semaphores, which none of our fences signals.
    m_device.waitIdle();
    VK_CHECK(vkQueueWaitIdle(m_device.queue));
    retireImages();
    const std::uint32_t maxImages = caps.maxImageCount ? caps.maxImageCount : ~0u;
    const VkSwapchainKHR old = m_swapchain;
    const VkSwapchainCreateInfoKHR info{
        .sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
        .surface = m_surface,
        .minImageCount = std::min(std::max(caps.minImageCount, kFramesInFlight + 1), maxImages),
        .imageFormat = format,
        .imageColorSpace = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR,
        .imageExtent = {width, height},
        .imageArrayLayers = 1,
        .imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        .imageSharingMode = VK_SHARING_MODE_EXCLUSIVE,
        .preTransform = caps.currentTransform,
        .compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR,
        .presentMode = choosePresentMode(m_device, m_surface),
        .clipped = VK_TRUE,
        .oldSwapchain = old,
    };
    VK_CHECK(vkCreateSwapchainKHR(m_device.device, &info, nullptr, &m_swapchain));
    m_device.retire(
        [device = m_device.device, old] { vkDestroySwapchainKHR(device, old, nullptr); });
    createViews();
    return true;
}

bool Swapchain::ready() const {
    return m_device.completed() >= m_submission[m_frame];
}

std::optional<std::uint32_t> Swapchain::acquire() {
    m_device.wait(m_submission[m_frame]); // its semaphore is free again
    constexpr std::uint64_t kNanoseconds = 5'000'000;
    std::uint32_t image = 0;
    const VkResult result =
        vkAcquireNextImageKHR(m_device.device, m_swapchain, kNanoseconds,
                              m_acquired[m_frame].handle, VK_NULL_HANDLE, &image);
    if (result == VK_ERROR_OUT_OF_DATE_KHR) {
        m_outdated = true;
        return {};
    }
    if (result == VK_TIMEOUT || result == VK_NOT_READY)
        return {};
    if (result == VK_SUBOPTIMAL_KHR)
        m_outdated = true; // this frame is still shown
    else
        check(result, "vkAcquireNextImageKHR");
    return image;
}

void Swapchain::present(VkCommandBuffer cmd, std::uint32_t image) {
    m_submission[m_frame] = m_device.submit(cmd, {.wait = m_acquired[m_frame].handle,
                                                  .waitStage = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                                  .signal = m_drawn[image]});
    m_frame = (m_frame + 1) % kFramesInFlight;
    const VkPresentInfoKHR info{
        .sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
        .waitSemaphoreCount = 1,
        .pWaitSemaphores = &m_drawn[image],
        .swapchainCount = 1,
        .pSwapchains = &m_swapchain,
        .pImageIndices = &image,
    };
    const VkResult result = vkQueuePresentKHR(m_device.queue, &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR)
        m_outdated = true;
    else
        check(result, "vkQueuePresentKHR");
}

} // namespace limn::gpu
