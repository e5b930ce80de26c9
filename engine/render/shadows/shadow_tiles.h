// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/shadowed_lights.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace limn::render {

/// A square piece of a layer of the shadow atlas [texels].
struct ShadowTile {
    std::uint32_t layer = 0, x = 0, y = 0, size = 0;
};

/// Which tiles of a stack of square layers are taken. Tiles have two sizes: small ones, 2^level to
/// half a layer's side, and large ones, twice as wide; a tile's place is a multiple of its size.
class ShadowTiles {
public:
    static constexpr std::uint32_t kLayerSize = 2048;             ///< texels
    static constexpr std::uint32_t kMaxLayers = kMaxShadowLayers; ///< of 32 bits per texel: 512 MiB
    static constexpr std::uint32_t kMaxLevel = 4;                 ///< small tiles of 64 x 64
    static constexpr std::uint32_t kLargeTile = 4;                ///< small ones in a large one

    static constexpr std::uint32_t smallSize(std::uint32_t level) {
        return kLayerSize >> (level + 1);
    }
    /// How many small tiles there are.
    static constexpr std::uint32_t room(std::uint32_t level) {
        return kMaxLayers * kLargeTile << (2 * level);
    }
    /// The least level with room for so many small tiles; none if there is none.
    static std::optional<std::uint32_t> levelFor(std::uint64_t smallTiles);

    /// All are free, and of this level from now on.
    void reset(std::uint32_t level);

    /// The first free place. None is left: then small ones lie so that no large one fits, if there
    /// is room at all. Large ones that are taken before small ones always fit.
    std::optional<std::uint32_t> take(bool large);
    void free(std::uint32_t place, bool large);
    ShadowTile tile(std::uint32_t place, bool large) const;

    std::uint32_t level() const { return m_level; }

private:
    std::uint32_t m_level = 0;
    std::vector<bool> m_taken;     ///< small tiles, layer after layer, in Morton order
    std::uint32_t m_firstFree = 0; ///< none before is free
};

} // namespace limn::render
