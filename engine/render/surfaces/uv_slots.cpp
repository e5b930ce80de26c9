// SPDX-License-Identifier: MIT
#include "engine/render/surfaces/uv_slots.h"

#include "engine/scene/surface/material_textures.h"

#include <algorithm>
#include <vector>

namespace limn::render {

UvSlots uvSlots(const Material& material) {
    Material copy = material;
    std::vector<std::uint32_t> sets;
    for (const TextureRef* texture : texturesOf(copy))
        if (texture->image >= 0)
            sets.push_back(texture->texCoord);
    std::ranges::sort(sets);
    sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
    UvSlots slots;
    if (sets.empty() || sets.back() < 2)
        return slots;
    for (std::size_t k = 0; k < std::min<std::size_t>(sets.size(), 2); ++k)
        slots.set[k] = sets[k];
    return slots;
}

} // namespace limn::render
