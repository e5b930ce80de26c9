// SPDX-License-Identifier: MIT
#include "engine/gpu/buffer.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/vulkan_error.h"

#include <cassert>
#include <cstring>

namespace limn::gpu {

Buffer::Buffer(Device& device, const BufferDesc& desc) : size(desc.size), m_device(&device) {
    assert(desc.size > 0);
    const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                  .size = desc.size,
                                  .usage = desc.usage,
                                  .sharingMode = VK_SHARING_MODE_EXCLUSIVE};
    VK_CHECK(vkCreateBuffer(device.device, &info, nullptr, &handle));
    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(device.device, handle, &requirements);
    try {
        m_memory = device.memory.allocate(requirements, desc.memory, false);
    } catch (...) {
        vkDestroyBuffer(device.device, handle, nullptr);
        throw;
    }
    VK_CHECK(vkBindBufferMemory(device.device, handle, m_memory.memory, m_memory.offset));
    mapped = m_memory.mapped;
    device.setName(VK_OBJECT_TYPE_BUFFER, std::uint64_t(handle), desc.name);
}

Buffer::~Buffer() {
    if (!handle)
        return;
    m_device->retire([d = m_device, h = handle, memory = m_memory] {
        vkDestroyBuffer(d->device, h, nullptr);
        d->memory.free(memory);
    });
}

void updateBuffer(Device& device, VkCommandBuffer cmd, const Buffer& buffer, VkDeviceSize offset,
                  std::span<const std::byte> bytes) {
    assert(offset + bytes.size() <= buffer.size);
    const Buffer staging(device, {.size = bytes.size(),
                                  .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                  .memory = MemoryKind::Upload,
                                  .name = "staging"});
    std::memcpy(staging.mapped, bytes.data(), bytes.size());
    const VkBufferCopy region{0, offset, bytes.size()};
    vkCmdCopyBuffer(cmd, staging.handle, buffer.handle, 1, &region);
    memoryBarrier(cmd, kTransferWrite, kAllReads);
}

Buffer uploadBuffer(Device& device, VkCommandBuffer cmd, std::span<const std::byte> bytes,
                    VkBufferUsageFlags usage, const char* name) {
    Buffer result(
        device,
        {.size = bytes.size(), .usage = usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, .name = name});
    updateBuffer(device, cmd, result, 0, bytes);
    return result;
}

void readBuffer(Device& device, const Buffer& buffer, std::span<std::byte> out) {
    assert(out.size() <= buffer.size);
    const Buffer staging(device, {.size = out.size(),
                                  .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                  .memory = MemoryKind::Readback,
                                  .name = "read-back"});
    device.immediate("read buffer", [&](VkCommandBuffer cmd) {
        memoryBarrier(cmd, kAllWrites, kTransferRead);
        const VkBufferCopy region{0, 0, out.size()};
        vkCmdCopyBuffer(cmd, buffer.handle, staging.handle, 1, &region);
        memoryBarrier(cmd, kTransferWrite, kHostRead);
    });
    std::memcpy(out.data(), staging.mapped, out.size());
}

} // namespace limn::gpu
