// SPDX-License-Identifier: MIT
#pragma once

#include "tests/trace/simple_scene.h"

#include <utility>

namespace limn::simple {

/// A material of that albedo with holes where the image's alpha is 0, without interpolation.
inline Material masked(SceneBuilder& b, Image image, glm::vec3 albedo) {
    Material m = lambert(albedo);
    m.alphaMode = AlphaMode::Mask;
    m.baseColorTexture.image = std::int32_t(b.assets->images.size());
    m.baseColorTexture.nearest = true;
    b.assets->images.push_back(std::move(image));
    return m;
}

} // namespace limn::simple
