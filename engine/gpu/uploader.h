// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/buffer.h"
#include "engine/gpu/image.h"

namespace limn::gpu {

/// Copies data to the GPU in few submissions with bounded staging memory. Returned resources may be
/// used by any later submission.
class Uploader {
public:
    explicit Uploader(Device& device) : m_device(device) {}
    ~Uploader() { flush(); }
    Uploader(const Uploader&) = delete;
    Uploader& operator=(const Uploader&) = delete;

    /// `bytes` must not be empty.
    Buffer buffer(std::span<const std::byte> bytes, VkBufferUsageFlags usage, const char* name);
    void image(const Image& target, std::span<const std::byte> bytes);
    void imageMakingMips(const Image& target, std::span<const std::byte> bytes);

    /// Submits what is pending; does not wait unless much is staged.
    void flush();

private:
    static constexpr VkDeviceSize kStagingLimit = 128ull << 20;
    VkCommandBuffer cmd(VkDeviceSize bytes);

    Device& m_device;
    VkCommandBuffer m_cmd = VK_NULL_HANDLE;
    VkDeviceSize m_staged = 0; ///< since the last wait
};

} // namespace limn::gpu
