// SPDX-License-Identifier: MIT
#include "engine/gpu/storage_maker.h"

#include "engine/gpu/barrier.h"

#include <algorithm>

#include <fmt/format.h>

namespace limn::gpu {

static constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                             VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT;

bool StorageMaker::fits(VkDeviceSize bytes, const char* name) {
    const VkDeviceSize maxBytes = m_device.properties.limits.maxStorageBufferRange;
    if (bytes > maxBytes && error.empty())
        error = fmt::format("{}: the {} of this bake take {:.1f} MiB, more than the {:.1f} MiB "
                            "that the device can bind; {}",
                            m_device.properties.deviceName, name, double(bytes) / (1 << 20),
                            double(maxBytes) / (1 << 20), m_advice);
    return bytes <= maxBytes;
}

Buffer StorageMaker::filledWith(std::span<const std::byte> bytes, const char* name) {
    return fits(bytes.size(), name) ? m_uploader.buffer(bytes, kUsage, name) : Buffer();
}

Buffer StorageMaker::empty(std::size_t count, std::size_t elementBytes, const char* name,
                           MemoryKind memory) {
    const VkDeviceSize bytes = std::max<std::size_t>(count, 1) * elementBytes;
    if (!fits(bytes, name))
        return {};
    return {m_device, {.size = bytes, .usage = kUsage, .memory = memory, .name = name}};
}

void clearBuffers(Device& device, std::initializer_list<VkBuffer> buffers) {
    const VkCommandBuffer cmd = device.begin("clear buffers");
    for (const VkBuffer b : buffers)
        vkCmdFillBuffer(cmd, b, 0, VK_WHOLE_SIZE, 0);
    memoryBarrier(cmd, kTransferWrite, kAllReads);
    device.submit(cmd);
}

} // namespace limn::gpu
