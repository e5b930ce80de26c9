// SPDX-License-Identifier: MIT
#include "engine/gpu/memory.h"

#include "engine/gpu/vulkan_error.h"

#include <algorithm>
#include <cassert>

namespace limn::gpu {

void MemoryBlocks::init(VkPhysicalDevice physicalDevice, VkDevice device) {
    m_device = device;
    vkGetPhysicalDeviceMemoryProperties(physicalDevice, &m_properties);
}

void MemoryBlocks::destroy() {
    for (const Block& block : m_blocks)
        if (block.memory)
            vkFreeMemory(m_device, block.memory, nullptr);
    m_blocks.clear();
    bytesInUse = bytesReserved = 0;
}

std::uint32_t MemoryBlocks::memoryType(std::uint32_t allowed, MemoryKind kind) const {
    constexpr VkMemoryPropertyFlags kMapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    const VkMemoryPropertyFlags need = kind == MemoryKind::Gpu ? 0 : kMapped;
    const VkMemoryPropertyFlags want = kind == MemoryKind::Gpu ? VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT
                                       : kind == MemoryKind::Readback
                                           ? VK_MEMORY_PROPERTY_HOST_CACHED_BIT
                                           : 0;
    std::uint32_t fallback = VK_MAX_MEMORY_TYPES;
    for (std::uint32_t i = 0; i < m_properties.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = m_properties.memoryTypes[i].propertyFlags;
        if (!(allowed & (1u << i)) || (flags & need) != need)
            continue;
        if ((flags & want) == want)
            return i;
        fallback = std::min(fallback, i);
    }
    if (fallback == VK_MAX_MEMORY_TYPES)
        throw VulkanError(VK_ERROR_FEATURE_NOT_PRESENT, "memory type");
    return fallback;
}

std::uint32_t MemoryBlocks::addBlock(VkDeviceSize size, std::uint32_t type, bool optimal,
                                     bool map) {
    Block block{.size = size, .type = type, .optimal = optimal};
    const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                    .pNext = nullptr,
                                    .allocationSize = size,
                                    .memoryTypeIndex = type};
    VK_CHECK(vkAllocateMemory(m_device, &info, nullptr, &block.memory));
    if (map)
        VK_CHECK(vkMapMemory(m_device, block.memory, 0, VK_WHOLE_SIZE, 0, &block.mapped));
    block.free = {{0, size}};
    bytesReserved += size;
    const auto slot = std::find_if(m_blocks.begin(), m_blocks.end(),
                                   [](const Block& b) { return b.memory == VK_NULL_HANDLE; });
    const auto index = std::uint32_t(slot - m_blocks.begin());
    if (slot == m_blocks.end())
        m_blocks.push_back(std::move(block));
    else
        *slot = std::move(block);
    return index;
}

bool MemoryBlocks::take(std::uint32_t index, VkDeviceSize size, VkDeviceSize alignment,
                        Allocation& out) {
    Block& block = m_blocks[index];
    for (std::size_t i = 0; i < block.free.size(); ++i) {
        const Range range = block.free[i];
        const VkDeviceSize offset = (range.offset + alignment - 1) / alignment * alignment;
        const VkDeviceSize end = offset + size, rangeEnd = range.offset + range.size;
        if (end > rangeEnd)
            continue;
        block.free.erase(block.free.begin() + std::ptrdiff_t(i));
        if (end < rangeEnd)
            block.free.insert(block.free.begin() + std::ptrdiff_t(i), {end, rangeEnd - end});
        if (offset > range.offset)
            block.free.insert(block.free.begin() + std::ptrdiff_t(i),
                              {range.offset, offset - range.offset});
        out = {block.memory, offset, size,
               block.mapped ? static_cast<char*>(block.mapped) + offset : nullptr, index};
        return true;
    }
    return false;
}

Allocation MemoryBlocks::allocate(const VkMemoryRequirements& requirements, MemoryKind kind,
                                  bool optimal) {
    const std::uint32_t type = memoryType(requirements.memoryTypeBits, kind);
    const bool map = kind != MemoryKind::Gpu;
    Allocation result;
    bool found = false;
    for (std::uint32_t i = 0; i < m_blocks.size() && !found; ++i) {
        const Block& block = m_blocks[i];
        if (block.memory && block.type == type && block.optimal == optimal &&
            (block.mapped != nullptr) == map)
            found = take(i, requirements.size, requirements.alignment, result);
    }
    if (!found) {
        const std::uint32_t block =
            addBlock(std::max(requirements.size, kBlockSize), type, optimal, map);
        found = take(block, requirements.size, requirements.alignment, result);
        assert(found);
    }
    bytesInUse += result.size;
    return result;
}

void MemoryBlocks::free(const Allocation& allocation) {
    if (!allocation.memory)
        return;
    Block& block = m_blocks[allocation.block];
    assert(block.memory == allocation.memory);
    bytesInUse -= allocation.size;
    auto next = std::find_if(block.free.begin(), block.free.end(),
                             [&](const Range& r) { return r.offset > allocation.offset; });
    next = block.free.insert(next, {allocation.offset, allocation.size});
    if (next + 1 != block.free.end() && next->offset + next->size == (next + 1)->offset) {
        next->size += (next + 1)->size;
        block.free.erase(next + 1);
    }
    if (next != block.free.begin() && (next - 1)->offset + (next - 1)->size == next->offset) {
        (next - 1)->size += next->size;
        block.free.erase(next);
    }
    // An empty block goes back to the driver when it was made for one large request.
    if (block.size > kBlockSize && block.free.size() == 1 && block.free[0].size == block.size) {
        vkFreeMemory(m_device, block.memory, nullptr);
        bytesReserved -= block.size;
        block = {};
    }
}

} // namespace limn::gpu
