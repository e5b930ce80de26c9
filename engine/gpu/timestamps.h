// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/handle.h"

#include <cstdint>
#include <vector>

namespace limn::gpu {

/// Writes the time at which all work recorded before is done. Not while rendering. The barrier
/// behind it makes a software rasteriser write it now and not with the work that follows.
void writeTimestamp(VkCommandBuffer cmd, VkQueryPool pool, std::uint32_t query);

/// Times how long the GPU takes over the steps of one command buffer.
class Timestamps {
public:
    Timestamps(Device& device, std::uint32_t most); ///< at most so many steps

    void begin(VkCommandBuffer cmd);
    /// A step ends here: when all work recorded before is done.
    void mark(VkCommandBuffer cmd);
    /// Per step since begin() [ms]. The command buffer must be done.
    std::vector<double> steps() const;

private:
    Device* m_device;
    QueryPool m_pool;
    std::uint32_t m_most, m_count = 0;
};

} // namespace limn::gpu
