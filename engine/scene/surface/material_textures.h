// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/surface/material.h"

#include <array>
#include <cstdint>
#include <set>

namespace limn {

/// Every texture of a material: base colour, metallic and roughness, normal, emission.
inline std::array<TextureRef*, 4> texturesOf(Material& material) {
    return {&material.baseColorTexture, &material.metallicRoughnessTexture, &material.normalTexture,
            &material.emissiveTexture};
}

/// The sets of texture coordinates that a material's textures read.
inline std::set<std::uint32_t> uvSetsOf(Material material) {
    std::set<std::uint32_t> sets;
    for (const TextureRef* texture : texturesOf(material))
        if (texture->image >= 0)
            sets.insert(texture->texCoord);
    return sets;
}

} // namespace limn
