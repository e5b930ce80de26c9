// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <vulkan/vulkan.h>

namespace limn::gpu {

/// Gpu: fastest for the device. Upload: the CPU writes, mapped. Readback: the CPU reads, mapped,
/// cached.
enum class MemoryKind { Gpu, Upload, Readback };

/// A piece of a block.
struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0, size = 0; ///< bytes
    void* mapped = nullptr;            ///< null for Gpu
    std::uint32_t block = 0;
};

/// Device memory in large blocks with first-fit free lists: drivers allow few allocations and make
/// them slowly.
class MemoryBlocks {
public:
    static constexpr VkDeviceSize kBlockSize = 64ull
                                               << 20; ///< larger requests get a block of their own

    void init(VkPhysicalDevice physicalDevice, VkDevice device);
    void destroy();

    /// `optimal`: for an image with optimal tiling; those never share a block with buffers, so
    /// bufferImageGranularity does not matter. Throws VulkanError when out of memory.
    Allocation allocate(const VkMemoryRequirements& requirements, MemoryKind kind, bool optimal);
    void free(const Allocation& allocation);

    std::uint64_t bytesInUse = 0;    ///< by live allocations
    std::uint64_t bytesReserved = 0; ///< by blocks

private:
    struct Range {
        VkDeviceSize offset, size;
    };
    struct Block {
        VkDeviceMemory memory = VK_NULL_HANDLE; ///< null: the slot is free
        VkDeviceSize size = 0;
        std::uint32_t type = 0;
        bool optimal = false;
        void* mapped = nullptr;
        std::vector<Range> free; ///< ascending, never adjacent
    };

    std::uint32_t memoryType(std::uint32_t allowed, MemoryKind kind) const;
    std::uint32_t addBlock(VkDeviceSize size, std::uint32_t type, bool optimal, bool map);
    bool take(std::uint32_t block, VkDeviceSize size, VkDeviceSize alignment, Allocation& out);

    VkDevice m_device = VK_NULL_HANDLE;
    VkPhysicalDeviceMemoryProperties m_properties{};
    std::vector<Block> m_blocks;
};

} // namespace limn::gpu
