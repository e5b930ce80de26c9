// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/handle.h"

#include <cstdint>
#include <vector>

namespace limn::gpu {

/// Writes the time at which all previously recorded work is done. Must not be called inside a
/// rendering. The barrier after it makes a software rasteriser write the time now and not with the
/// work that follows.
void writeTimestamp(VkCommandBuffer cmd, VkQueryPool pool, std::uint32_t query);

/// Measures the GPU time of each step of one command buffer.
class Timestamps {
public:
    Timestamps(Device& device, std::uint32_t maxSteps); ///< `maxSteps`: maximum number of steps

    void begin(VkCommandBuffer cmd);
    /// Ends a step at the time when all previously recorded work is done.
    void mark(VkCommandBuffer cmd);
    /// Duration of each step since begin() [ms]. The command buffer must have completed.
    std::vector<double> steps() const;

private:
    Device* m_device;
    QueryPool m_pool;
    std::uint32_t m_maxQueries, m_count = 0;
};

} // namespace limn::gpu
