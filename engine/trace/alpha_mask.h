// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace limn {

/// Alpha channel of an image, row 0 at the top.
struct AlphaImage {
    int width = 0, height = 0;
    std::vector<std::uint8_t> alpha; ///< width * height
};

/// Alpha test of one mesh with one cutout material, cheap enough for every ray. Agrees with
/// surfaceAlpha(). Points into the mesh, which must outlive it.
struct AlphaMask {
    const Mesh* mesh = nullptr;
    const std::vector<glm::vec2>* uv = nullptr; ///< null: no texture or no coordinates
    TextureRef texture;
    float factor = 1; ///< the base colour's alpha
    float cutoff = 0.5f;
    std::shared_ptr<const AlphaImage> image; ///< null: 1 everywhere
};

/// Alpha channels extracted from Assets::images so far, by image index.
using AlphaImages = std::map<std::int32_t, std::shared_ptr<const AlphaImage>>;

/// Creates the mask of a mesh. `material` must satisfy isCutout().
AlphaMask makeAlphaMask(const Assets& assets, const Mesh& mesh, const Material& material,
                        AlphaImages& images);

/// One corner of a triangle as its alpha test sees it.
struct AlphaCorner {
    glm::vec2 uv{0};  ///< in the image, after the texture's transform
    float factor = 1; ///< what multiplies the image's alpha
};
std::array<AlphaCorner, 3> alphaCorners(const AlphaMask& mask, std::uint32_t triangle);

/// Whether the surface exists, alpha >= cutoff, at barycentrics (u, v) of `triangle`.
bool opaqueAt(const AlphaMask& mask, std::uint32_t triangle, float u, float v);

} // namespace limn
