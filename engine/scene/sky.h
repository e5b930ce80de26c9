// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/sky_image.h"

#include <memory>
#include <string>

namespace limn {

/// The sky's cells as a bake counts them: bands of equal height by sectors about +Y.
inline constexpr std::uint32_t kSkyBands = 16, kSkySectors = 16;

/// A panorama with what lighting by it needs.
struct SkyImage {
    ImageF pixels; ///< finite, >= 0, not empty
    SkyBands bands;
};
std::shared_ptr<const SkyImage> makeSkyImage(ImageF pixels);

/// One colour, or an image round the scene. One per document.
struct Sky {
    glm::vec3 radiance{0}; ///< [nits], linear; of all directions where there is no image
    std::string image;     ///< panorama's file, as opened; empty: none
    float strength = 1;    ///< times the image's radiance, >= 0
    float rotation = 0;    ///< of the image about +Y, from +Z towards +X [rad]
    /// Pixels of `image`. Without them the sky has its colour. Not compared: the file's name is.
    std::shared_ptr<const SkyImage> panorama = nullptr;

    bool operator==(const Sky& other) const;
};

/// Radiance [nits] from direction `d` (unit).
glm::vec3 skyRadiance(const Sky& sky, glm::vec3 d);

/// Mean radiance of each cell, by skyCellOf().
std::vector<glm::vec3> skyCellRadiance(const Sky& sky);

/// Mean over all directions.
glm::vec3 meanRadiance(const Sky& sky);

} // namespace limn
