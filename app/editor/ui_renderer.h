// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/swapchain.h"

#include <glm/vec2.hpp>

namespace limn {

/// A rectangle of a finished image that fills a rectangle of the window.
struct WindowPicture {
    VkImage image =
        VK_NULL_HANDLE; ///< in SHADER_READ_ONLY_OPTIMAL before and after; null: nothing yet
    glm::uvec2 size{0}; ///< its corner (0, 0, size) is shown [px]
    glm::ivec2 begin{0}, end{0}; ///< where in the window [px]
};

/// Draws ImGui's lists over a picture into a swapchain, with ImGui's own Vulkan backend, which
/// requires a VkRenderPass. Create it after ImGui's context and fonts and destroy it before them.
/// There is only one at a time.
class UiRenderer {
public:
    UiRenderer(gpu::Device& device, const gpu::Swapchain& swapchain);
    ~UiRenderer();
    UiRenderer(const UiRenderer&) = delete;
    UiRenderer& operator=(const UiRenderer&) = delete;

    /// Call after the swapchain was resized.
    void resized();

    /// Records the whole window into image `index` and leaves it ready to present.
    void record(VkCommandBuffer cmd, std::uint32_t index, const WindowPicture& picture);

private:
    void retireFramebuffers();

    gpu::Device& m_device;
    const gpu::Swapchain& m_swapchain;
    VkRenderPass m_renderPass = VK_NULL_HANDLE;
    gpu::DescriptorPool m_pool;
    std::vector<VkFramebuffer> m_framebuffers;
};

} // namespace limn
