// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/handle.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace limn::gpu {

/// The images of a window. Owns the surface too. Images are 8-bit UNORM; colours written to them
/// are sRGB-encoded. Usable as colour attachment and as the destination of a blit.
class Swapchain {
public:
    /// Maximum number of frames between acquire() and the end of their work on the GPU.
    static constexpr std::uint32_t kFramesInFlight = 2;

    /// Takes ownership of `surface`, which belongs to the device's instance. There are no images
    /// before resize().
    Swapchain(Device& device, VkSurfaceKHR surface);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// Creates images of this size [px], or of the surface's own size if it fixes one. Old images
    /// are destroyed after their frames. Returns false if the window is minimised; there are no
    /// images then.
    bool resize(std::uint32_t newWidth, std::uint32_t newHeight);

    /// True if acquire() would not wait for the GPU.
    bool ready() const;

    /// Index of the next image to draw; std::nullopt if the window changed size (resize() is due)
    /// or no image was available in time.
    std::optional<std::uint32_t> acquire();
    /// Submits `cmd` and presents the acquired image. `cmd` first accesses the image in the
    /// transfer stage and leaves it in PRESENT_SRC_KHR.
    void present(VkCommandBuffer cmd, std::uint32_t image);

    bool outdated() const { return m_outdated; } ///< resize() is due

    VkFormat format = VK_FORMAT_UNDEFINED;
    std::uint32_t width = 0, height = 0;
    std::vector<VkImage> images;
    std::vector<VkImageView> views;

private:
    void retireImages();
    void createViews();

    Device& m_device;
    VkSurfaceKHR m_surface = VK_NULL_HANDLE;
    VkSwapchainKHR m_swapchain = VK_NULL_HANDLE;
    std::vector<VkSemaphore> m_drawn; ///< per image
    Semaphore m_acquired[kFramesInFlight];
    std::uint64_t m_submission[kFramesInFlight] = {};
    std::uint32_t m_frame = 0;
    bool m_outdated = true;
};

} // namespace limn::gpu
