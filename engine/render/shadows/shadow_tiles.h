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

/// Allocator of tiles in a stack of square layers. Tiles have two sizes: small ones, of which
/// 2^level fit along half a layer's side, and large ones, which are twice as wide. A tile's place
/// is a multiple of its size.
class ShadowTiles {
public:
    static constexpr std::uint32_t kLayerSize = 2048;             ///< texels
    static constexpr std::uint32_t kMaxLayers = kMaxShadowLayers; ///< 512 MiB at 32 bits per texel
    static constexpr std::uint32_t kMaxLevel = 4;                 ///< small tiles of 64 x 64 texels
    static constexpr std::uint32_t kLargeTile = 4;                ///< small tiles per large tile

    static constexpr std::uint32_t smallSize(std::uint32_t level) {
        return kLayerSize >> (level + 1);
    }
    /// Number of small tiles at this level.
    static constexpr std::uint32_t room(std::uint32_t level) {
        return kMaxLayers * kLargeTile << (2 * level);
    }
    /// Smallest level with room for this many small tiles; std::nullopt if there is none.
    static std::optional<std::uint32_t> levelFor(std::uint64_t smallTiles);

    /// Frees all tiles and sets the level.
    void reset(std::uint32_t level);

    /// Takes the first free place; std::nullopt if none is free. Small tiles may lie so that no
    /// large one fits although there is room; large tiles taken before all small ones always fit.
    std::optional<std::uint32_t> take(bool large);
    void free(std::uint32_t place, bool large);
    ShadowTile tile(std::uint32_t place, bool large) const;

    std::uint32_t level() const { return m_level; }

private:
    std::uint32_t m_level = 0;
    std::vector<bool> m_taken;     ///< small tiles, layer after layer, in Morton order
    std::uint32_t m_firstFree = 0; ///< no place before it is free
};

} // namespace limn::render
