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

/// Bilinear lookup that follows the glTF rules (wrap, texture transform, sRGB decoding). `uv` is
/// the mesh's coordinate before the texture transform. Returns white if there is no image.
glm::vec4 sampleTexture(const Assets& assets, const TextureRef& texture, glm::vec2 uv, bool srgb);

/// What the texels of an image represent, which determines how they are averaged.
enum class TexelKind : std::uint8_t {
    Color,       ///< sRGB, decoded before averaging
    CutoutColor, ///< the same, weighted by alpha, because holes have no colour
    Data         ///< linear
};

/// Mean over a footprint: a trilinear lookup in box-filtered mips, on the level whose texels have
/// the footprint's area. `uvArea` is that area in the units of `uv`, squared. Footprints of one
/// image texel or less use sampleTexture(). The first lookup of an image builds its mips.
glm::vec4 sampleTextureFootprint(const Assets& assets, const TextureRef& texture, glm::vec2 uv,
                                 float uvArea, TexelKind kind);

/// Mip levels of an image from half its size down to one texel, linear, as binary16 RGBA
/// (CutoutColor: colour times alpha). All levels have the same mean, whatever the image's size.
struct MipChain {
    struct Level {
        std::uint32_t width, height;
        std::vector<std::array<std::uint16_t, 4>> rgba; ///< row 0 at the top
    };
    std::vector<Level> levels; ///< the first one has half the image's size
};
MipChain buildMips(const Image& image, TexelKind kind);

/// Mips of a scene's images, built on first use and shared from then on. They take 8/3 bytes per
/// texel of an image, two thirds of the image itself. Thread-safe.
class MipStore {
public:
    MipStore() = default;
    /// A copy starts empty, because its images may change.
    MipStore(const MipStore&) {}
    MipStore& operator=(const MipStore&) = delete;

    /// Mips of images[image]. All calls must pass the same images.
    const MipChain& of(const std::vector<Image>& images, std::size_t image, TexelKind kind) const;

    /// Memory of all mips built so far [bytes]. Must not be called while another thread requests
    /// mips.
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
