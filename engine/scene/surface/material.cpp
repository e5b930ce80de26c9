// SPDX-License-Identifier: MIT
#include "engine/scene/surface/material.h"

#include <cmath>

namespace limn {

std::uint32_t frameAt(const Flipbook& flipbook, double seconds) {
    const double frames = double(flipbook.columns) * flipbook.rows;
    const double frame = std::floor(seconds * double(flipbook.framesPerSecond));
    return std::isfinite(frame) ? std::uint32_t(frame - frames * std::floor(frame / frames)) : 0;
}

TextureRef emissiveTextureAt(const Material& material, double seconds) {
    const Flipbook& flipbook = material.emissiveFlipbook;
    TextureRef texture = material.emissiveTexture;
    const std::uint32_t frame = frameAt(flipbook, seconds);
    const glm::vec2 share = 1.f / glm::vec2(flipbook.columns, flipbook.rows);
    texture.offset =
        (texture.offset + glm::vec2(frame % flipbook.columns, frame / flipbook.columns)) * share;
    texture.scale *= share;
    return texture;
}

bool isAnimated(const Material& material) {
    const Flipbook& flipbook = material.emissiveFlipbook;
    return material.emissiveTexture.image >= 0 && flipbook.columns * flipbook.rows > 1 &&
           flipbook.framesPerSecond > 0;
}

bool isTwoSided(const Material& material) {
    return material.doubleSided;
}

} // namespace limn
