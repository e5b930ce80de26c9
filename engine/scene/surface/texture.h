// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/image.h"
#include "engine/scene/surface/material.h"

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace limn {

struct Assets;

/// Bilinear lookups that follow the glTF rules (wrap, texture transform, sRGB decoding).
/// `uv` is the mesh's coordinate before the texture transform. Without an image: white.
glm::vec4 sampleTexture(const Assets& assets, const TextureRef& texture, glm::vec2 uv, bool srgb);

/// What the texels of an image mean, and so how they are averaged.
enum class TexelKind : std::uint8_t {
    Color,       ///< sRGB, decoded before averaging
    CutoutColor, ///< the same; colours weigh as much as their alpha, as holes have none
    Data         ///< linear
};

/// The mean over a footprint: trilinear lookup in box-filtered mips, on the level whose texels have
/// the footprint's area. `uvArea` is that area in the units of `uv`, squared. From one texel of the
/// image down it is sampleTexture(). The first lookup of an image makes its mips.
glm::vec4 sampleTextureFootprint(const Assets& assets, const TextureRef& texture, glm::vec2 uv,
                                 float uvArea, TexelKind kind);

/// An image's halves, quarters … down to a texel, linear, as binary16 RGBA (CutoutColor: colour
/// times alpha). The mean is the same on each level, whatever the image's size.
struct MipChain {
    struct Level {
        std::uint32_t width, height;
        std::vector<std::array<std::uint16_t, 4>> rgba; ///< row 0 at the top
    };
    std::vector<Level> levels; ///< of half the image's size first
};
MipChain buildMips(const Image& image, TexelKind kind);

/// Mips of a scene's images, made when first asked for and shared from then on: 8/3 bytes per texel
/// of an image, two thirds of what the image takes itself. Any thread may ask.
class MipStore {
public:
    MipStore() = default;
    /// A copy starts empty, as its images may be changed.
    MipStore(const MipStore&) {}
    MipStore& operator=(const MipStore&) = delete;

    /// Mips of images[image]; the images must be those of all other calls.
    const MipChain& of(const std::vector<Image>& images, std::size_t image, TexelKind kind) const;

    /// [bytes] made so far. No other thread may be asking.
    std::uint64_t bytes() const;

private:
    static constexpr std::size_t kKinds = 3;
    struct Entry {
        std::once_flag once;
        MipChain mips;
    };
    mutable std::once_flag m_once;
    mutable std::unique_ptr<Entry[]> m_entries; ///< per image and kind
    mutable std::size_t m_count = 0;
};

} // namespace limn
