// SPDX-License-Identifier: MIT
#include "engine/gpu/timestamps.h"

#include "engine/gpu/barrier.h"
#include "engine/gpu/vulkan_error.h"

#include <cassert>

namespace limn::gpu {

void writeTimestamp(VkCommandBuffer cmd, VkQueryPool pool, std::uint32_t query) {
    vkCmdWriteTimestamp2(cmd, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool, query);
    memoryBarrier(cmd, kAllWrites, kAllReads);
}

Timestamps::Timestamps(Device& device, std::uint32_t maxSteps)
    : m_device(&device), m_maxQueries(maxSteps + 1) {
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
    writeTimestamp(cmd, m_pool.handle, m_count++);
}

std::vector<double> Timestamps::steps() const {
    std::vector<std::uint64_t> ticks(m_count);
    VK_CHECK(vkGetQueryPoolResults(m_device->device, m_pool.handle, 0, m_count,
                                   ticks.size() * sizeof(std::uint64_t), ticks.data(),
                                   sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT));
    std::vector<double> ms;
    for (std::size_t i = 1; i < ticks.size(); ++i)
        ms.push_back(ticks[i] > ticks[i - 1]
                         ? double(ticks[i] - ticks[i - 1]) *
                               double(m_device->properties.limits.timestampPeriod) * 1e-6
                         : 0);
    return ms;
}

} // namespace limn::gpu
