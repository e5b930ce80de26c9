// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/sky_image.h"

#include <cstdint>
#include <memory>
#include <string>

namespace limn {

/// Division of the sky into cells for a bake: bands of equal height by sectors about +Y.
inline constexpr std::uint32_t kSkyBands = 16, kSkySectors = 16;

/// A panorama with the precomputed means that lighting needs.
struct SkyImage {
    ImageF pixels; ///< finite, >= 0, not empty
    SkyBands bands;
};
std::shared_ptr<const SkyImage> makeSkyImage(ImageF pixels);

enum class SkyKind : std::uint8_t { Color, Gradient, Image };

/// Light from all directions around the scene. One per document. Colours are linear [nits].
struct Sky {
    SkyKind kind = SkyKind::Color;
    glm::vec3 radiance{0}; ///< of all directions; of a gradient: straight up
    glm::vec3 horizon{0};  ///< of a gradient, which is linear in the sine of the elevation
    glm::vec3 ground{0};   ///< of a gradient, straight down
    std::string image;     ///< panorama's file, as opened; empty: none
    float strength = 1;    ///< times the image's radiance, >= 0
    float rotation = 0;    ///< of the image about +Y, from +Z towards +X [rad]
    /// Pixels of `image`. Without them an image counts as a single colour. Comparisons only check
    /// whether they are present: the file's name identifies them.
    std::shared_ptr<const SkyImage> panorama = nullptr;

    bool operator==(const Sky& other) const;
    bool showsImage() const { return kind == SkyKind::Image && panorama; }
};

/// Radiance [nits] from direction `d` (unit).
glm::vec3 skyRadiance(const Sky& sky, glm::vec3 d);

/// Mean radiance of each cell, indexed by skyCellOf(); exact for every kind.
std::vector<glm::vec3> skyCellRadiance(const Sky& sky);

} // namespace limn
