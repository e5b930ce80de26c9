// SPDX-License-Identifier: MIT
#include "engine/gpu/timestamps.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/vulkan_error.h"

#include <cassert>

namespace limn::gpu {

Timestamps::Timestamps(Device& device, std::uint32_t maxSteps)
    : m_device(&device), m_maxQueries(maxSteps + 1), m_ticks(maxSteps + 1) {
    const VkQueryPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                     .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                     .queryCount = m_maxQueries};
    VkQueryPool pool = VK_NULL_HANDLE;
    VK_CHECK(vkCreateQueryPool(device.device, &info, nullptr, &pool));
    m_pool = QueryPool(device, pool);
}

void Timestamps::begin(VkCommandBuffer cmd) {
    vkCmdResetQueryPool(cmd, m_pool.handle, 0, m_maxQueries);
    m_count = 0;
    mark(cmd);
}

void Timestamps::mark(VkCommandBuffer cmd) {
    assert(m_count < m_maxQueries);
    vkCmdWriteTimestamp2(cmd, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, m_pool.handle, m_count++);
    // A software rasteriser writes the time now and not with the work that follows.
    memoryBarrier(cmd, kAllWrites, kAllReads);
}

std::span<const double> Timestamps::steps() {
    VK_CHECK(vkGetQueryPoolResults(m_device->device, m_pool.handle, 0, m_count,
                                   m_count * sizeof(std::uint64_t), m_ticks.data(),
                                   sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT));
    const double msPerTick = double(m_device->properties.limits.timestampPeriod) * 1e-6;
    m_ms.clear();
    for (std::size_t i = 1; i < m_count; ++i)
        m_ms.push_back(m_ticks[i] > m_ticks[i - 1] ? double(m_ticks[i] - m_ticks[i - 1]) * msPerTick
                                                   : 0);
    return m_ms;
}

} // namespace limn::gpu
