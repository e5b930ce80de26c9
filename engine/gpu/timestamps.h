// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/handle.h"

#include <cstdint>
#include <span>
#include <vector>

namespace limn::gpu {

/// Measures the GPU time of each step of one command buffer.
class Timestamps {
public:
    Timestamps(Device& device, std::uint32_t maxSteps); ///< `maxSteps`: maximum number of steps

    void begin(VkCommandBuffer cmd);
    /// Ends a step at the time when all previously recorded work is done. Must not be called inside
    /// a rendering.
    void mark(VkCommandBuffer cmd);
    /// Duration of each step since begin() [ms], until the next call. The command buffer must have
    /// completed.
    std::span<const double> steps();

private:
    Device* m_device;
    QueryPool m_pool;
    std::uint32_t m_maxQueries, m_count = 0;
    std::vector<std::uint64_t> m_ticks;
    std::vector<double> m_ms;
};

} // namespace limn::gpu
