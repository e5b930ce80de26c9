// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Place of `p` along a Morton curve through the unit cube, in 1024 steps along each axis, of which
/// x counts most. Points outside count as the nearest inside. Points that are close along the curve
/// are close in space. Morton. A Computer Oriented Geodetic Data Base and a New Technique in File
/// Sequencing. 1966
inline std::uint32_t mortonCode(glm::vec3 p) {
    const glm::uvec3 cell(glm::clamp(p * 1024.f, 0.f, 1023.f));
    const auto spread = [](std::uint32_t x) { // two zeros after each of the lowest 10 bits
        x = (x | x << 16) & 0x030000ffU;
        x = (x | x << 8) & 0x0300f00fU;
        x = (x | x << 4) & 0x030c30c3U;
        return (x | x << 2) & 0x09249249U;
    };
    return spread(cell.x) << 2 | spread(cell.y) << 1 | spread(cell.z);
}

} // namespace limn
