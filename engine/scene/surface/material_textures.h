// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/surface/material.h"

#include <array>

namespace limn {

/// Every texture of a material: base colour, metallic and roughness, normal, emission.
inline std::array<TextureRef*, 4> texturesOf(Material& material) {
    return {&material.baseColorTexture, &material.metallicRoughnessTexture, &material.normalTexture,
            &material.emissiveTexture};
}

} // namespace limn
