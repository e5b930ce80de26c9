// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/device.h"

#include <span>
#include <utility>

namespace limn::gpu {

struct BufferDesc {
    VkDeviceSize size = 0; ///< bytes, > 0
    VkBufferUsageFlags usage = 0;
    MemoryKind memory = MemoryKind::Gpu;
    const char* name = ""; ///< shown by validation layers and captures
};

/// Owns a VkBuffer and its memory. Move-only; empty after a move. The destructor retires both, so
/// there is no need to wait for the GPU before dropping a buffer.
class Buffer {
public:
    Buffer() = default;
    Buffer(Device& device, const BufferDesc& desc); ///< Throws VulkanError when out of memory.
    ~Buffer();
    Buffer(Buffer&& other) noexcept { swap(other); }
    Buffer& operator=(Buffer other) noexcept {
        swap(other);
        return *this;
    }
    explicit operator bool() const { return handle != VK_NULL_HANDLE; }

    VkBuffer handle = VK_NULL_HANDLE;
    VkDeviceSize size = 0;
    void* mapped = nullptr; ///< Persistently mapped, coherent, for Upload and Readback; else null.

private:
    void swap(Buffer& other) noexcept {
        std::swap(handle, other.handle);
        std::swap(size, other.size);
        std::swap(mapped, other.mapped);
        std::swap(m_memory, other.m_memory);
        std::swap(m_device, other.m_device);
    }

    Allocation m_memory;
    Device* m_device = nullptr;
};

/// Creates a Gpu buffer and fills it with `bytes` through a staging copy recorded into `cmd`; a
/// barrier follows that makes it visible to every later read. `bytes` must not be empty;
/// TRANSFER_DST is added to `usage`.
Buffer uploadBuffer(Device& device, VkCommandBuffer cmd, std::span<const std::byte> bytes,
                    VkBufferUsageFlags usage, const char* name);

/// Replaces the bytes of a buffer (TRANSFER_DST) from `offset` on through a staging copy recorded
/// into `cmd`; a barrier follows that makes them visible to every later read. Reads of the old
/// bytes must have completed or be ordered before the copy by a barrier. `bytes` must not be empty.
void updateBuffer(Device& device, VkCommandBuffer cmd, const Buffer& buffer, VkDeviceSize offset,
                  std::span<const std::byte> bytes);

/// Copies a whole buffer (TRANSFER_SRC) to the CPU. Waits for the GPU.
void readBuffer(Device& device, const Buffer& buffer, std::span<std::byte> out);

} // namespace limn::gpu
