// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <vulkan/vulkan.h>

namespace limn::gpu {

/// Gpu: fastest for the device. Upload: mapped, written by the CPU. Readback: mapped and cached,
/// read by the CPU.
enum class MemoryKind { Gpu, Upload, Readback };

/// A range of a memory block.
struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0, size = 0; ///< bytes
    void* mapped = nullptr;            ///< null for Gpu
    std::uint32_t block = 0;
};

/// Allocates device memory from large blocks with first-fit free lists, because drivers allow only
/// few allocations and make them slowly.
class MemoryBlocks {
public:
    static constexpr VkDeviceSize kBlockSize = 64ull
                                               << 20; ///< larger requests get a block of their own

    void init(VkPhysicalDevice physicalDevice, VkDevice device);
    void destroy();

    /// Set `optimal` for images with optimal tiling; they never share a block with buffers, so
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
