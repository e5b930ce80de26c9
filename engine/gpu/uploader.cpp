// SPDX-License-Identifier: MIT
#include "engine/gpu/uploader.h"

namespace limn::gpu {

VkCommandBuffer Uploader::cmd(VkDeviceSize bytes) {
    if (m_staged > 0 && m_staged + bytes > kStagingLimit) {
        flush();
        m_device.waitIdle();
        m_staged = 0;
    }
    m_staged += bytes;
    if (!m_cmd)
        m_cmd = m_device.begin("upload");
    return m_cmd;
}

Buffer Uploader::buffer(std::span<const std::byte> bytes, VkBufferUsageFlags usage,
                        const char* name) {
    return uploadBuffer(m_device, cmd(bytes.size()), bytes, usage, name);
}

void Uploader::image(const Image& target, std::span<const std::byte> bytes) {
    uploadImage(m_device, cmd(bytes.size()), target, bytes);
}

void Uploader::imageMakingMips(const Image& target, std::span<const std::byte> bytes) {
    uploadImageMakingMips(m_device, cmd(bytes.size()), target, bytes);
}

void Uploader::flush() {
    if (m_cmd)
        m_device.submit(m_cmd);
    m_cmd = VK_NULL_HANDLE;
}

} // namespace limn::gpu
