// SPDX-License-Identifier: MIT
#include "engine/render/shadows/shadow_tiles.h"

#include <algorithm>
#include <cassert>

namespace limn::render {

std::optional<std::uint32_t> ShadowTiles::levelFor(std::uint64_t smallTiles) {
    for (std::uint32_t level = 0; level <= kMaxLevel; ++level)
        if (smallTiles <= room(level))
            return level;
    return {};
}

void ShadowTiles::reset(std::uint32_t level) {
    assert(level <= kMaxLevel);
    m_level = level;
    m_taken.assign(room(level), false);
    m_firstFree = 0;
}

std::optional<std::uint32_t> ShadowTiles::take(bool large) {
    const auto end = m_taken.end();
    if (!large) {
        const auto tile = std::find(m_taken.begin() + m_firstFree, end, false);
        m_firstFree = std::uint32_t(tile - m_taken.begin());
        if (tile == end)
            return {};
        *tile = true;
        return m_firstFree++;
    }
    const std::uint32_t start = (m_firstFree + kLargeTile - 1) / kLargeTile * kLargeTile;
    for (auto tile = m_taken.begin() + start; tile < end; tile += kLargeTile) {
        if (std::find(tile, tile + kLargeTile, true) != tile + kLargeTile)
            continue;
        std::fill_n(tile, kLargeTile, true);
        return std::uint32_t(tile - m_taken.begin());
    }
    return {};
}

void ShadowTiles::free(std::uint32_t place, bool large) {
    std::fill_n(m_taken.begin() + place, large ? kLargeTile : 1, false);
    m_firstFree = std::min(m_firstFree, place);
}

// Every second bit: four tiles in a row are a square.
static std::uint32_t evenBits(std::uint32_t v) {
    std::uint32_t out = 0;
    for (std::uint32_t bit = 0; v >> (2 * bit) != 0; ++bit)
        out |= (v >> (2 * bit) & 1) << bit;
    return out;
}

ShadowTile ShadowTiles::tile(std::uint32_t place, bool large) const {
    const std::uint32_t perLayer = kLargeTile << (2 * m_level), size = smallSize(m_level);
    const std::uint32_t inLayer = place % perLayer;
    return {.layer = place / perLayer,
            .x = evenBits(inLayer) * size,
            .y = evenBits(inLayer >> 1) * size,
            .size = large ? 2 * size : size};
}

} // namespace limn::render
