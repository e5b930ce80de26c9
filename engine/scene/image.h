// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

/// Pixels of a texture as stored in the file: 8 bits per channel, RGBA, row 0 at the top (glTF's v
/// = 0). Colour images hold sRGB, data images (normals, roughness) linear numbers; the image itself
/// does not record which.
struct Image {
    std::string name; ///< file name or glTF name, for messages
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba; ///< width * height * 4

    bool operator==(const Image&) const = default;
};

/// Linear Rec. 709, scene-referred float pixels (skies, renders). Row 0 at the top.
struct ImageF {
    std::uint32_t width = 0, height = 0;
    std::vector<glm::vec3> rgb; ///< width * height

    bool operator==(const ImageF&) const = default;
};

} // namespace limn
