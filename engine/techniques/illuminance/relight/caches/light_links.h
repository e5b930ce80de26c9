// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

namespace limn {

/// How many bands are lit: luma in [2, kMaxBands] and no more than the links of
/// LinkStorage::Sh have; chroma in [1, luma].
struct LightBands {
    int luma = 3, chroma = 3;
};

/// Which links are read: of cache c those from Caches::linkBegin[c] to end[c].
using LinkEnds = std::span<const std::uint32_t>;

/// Halfs of links of LinkStorage::Sh, as many for each, at least LightBands::luma^2.
using LinkHalfs = std::span<const std::uint16_t>;

/// What the links of cache c are multiplied with.
inline float linkScale(const Caches& caches, std::uint32_t c) {
    return std::ldexp(1.f, -caches.linkExponent[c]);
}

// The sums of lightCaches, of radiosity as withLuma keeps it, for the caches [begin, end), on one
// thread, by the widest vectors that this machine has. The order of a cache's sums depends on the
// machine's vectors, so results of two kinds of machine agree to rounding only.

/// Of links of LinkStorage::Rtp: one link per lane. Whole vectors of links to nodes without light
/// are passed over, which changes no sum; returns how many links that are.
std::size_t lightCones(const Caches& caches, LinkEnds ends, const std::vector<glm::vec4>& radiosity,
                       LightBands bands, std::uint32_t begin, std::uint32_t end, glm::vec3* sh);

/// Of links of LinkStorage::Sh: one coefficient per lane. Those without light are read like all:
/// memory brings their coefficients with the others', and finding them takes longer than that.
void lightHarmonics(const Caches& caches, LinkEnds ends, const std::vector<glm::vec4>& radiosity,
                    LightBands bands, LinkHalfs halfs, std::uint32_t begin, std::uint32_t end,
                    glm::vec3* sh);

} // namespace limn
