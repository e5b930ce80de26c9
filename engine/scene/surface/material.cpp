// SPDX-License-Identifier: MIT
#include "engine/scene/surface/material.h"

#include <cmath>

namespace limn {

std::uint32_t frameAt(const Flipbook& film, double seconds) {
    const double frames = double(film.columns) * film.rows;
    const double at = std::floor(seconds * double(film.framesPerSecond));
    return std::isfinite(at) ? std::uint32_t(at - frames * std::floor(at / frames)) : 0;
}

TextureRef emissiveTextureAt(const Material& material, double seconds) {
    const Flipbook& film = material.emissiveFilm;
    TextureRef texture = material.emissiveTexture;
    const std::uint32_t frame = frameAt(film, seconds);
    const glm::vec2 share = 1.f / glm::vec2(film.columns, film.rows);
    texture.offset =
        (texture.offset + glm::vec2(frame % film.columns, frame / film.columns)) * share;
    texture.scale *= share;
    return texture;
}

bool isAnimated(const Material& material) {
    const Flipbook& film = material.emissiveFilm;
    return material.emissiveTexture.image >= 0 && film.columns * film.rows > 1 &&
           film.framesPerSecond > 0;
}

bool isTwoSided(const Material& material) {
    return material.doubleSided;
}

} // namespace limn
