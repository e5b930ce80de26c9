// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/surface/material.h"

#include <array>
#include <cstdint>

namespace limn::render {

/// The two sets of texture coordinates that vertices carry: 0 and 1, unless the material reads
/// others, when they are the first two that it reads. A texture of a third set uses the second one.
struct UvSlots {
    std::array<std::uint32_t, 2> set{0, 1};

    std::uint32_t of(std::uint32_t texCoord) const { return texCoord == set[0] ? 0 : 1; }
};
UvSlots uvSlots(const Material& material);

} // namespace limn::render
