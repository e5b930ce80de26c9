// SPDX-License-Identifier: MIT
#include "engine/render/surfaces/uv_slots.h"

#include "engine/scene/surface/material_textures.h"

#include <set>

namespace limn::render {

UvSlots uvSlots(const Material& material) {
    const std::set<std::uint32_t> sets = uvSetsOf(material);
    UvSlots slots;
    if (sets.empty() || *sets.rbegin() < 2)
        return slots;
    auto set = sets.begin();
    for (std::size_t k = 0; k < slots.set.size() && set != sets.end(); ++k)
        slots.set[k] = *set++;
    return slots;
}

} // namespace limn::render
