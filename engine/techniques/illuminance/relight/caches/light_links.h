// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

namespace limn {

/// Number of bands that are lit: luma in [2, kMaxBands] and no more than the links of
/// LinkStorage::Sh have; chroma in [1, luma].
struct LightBands {
    int luma = 3, chroma = 3;
};

/// The links that are read: for cache c, those from Caches::linkBegin[c] to end[c].
using LinkEnds = std::span<const std::uint32_t>;

/// Halfs of links of LinkStorage::Sh, the same number for each link, at least LightBands::luma^2.
using LinkHalfs = std::span<const std::uint16_t>;

/// Factor that undoes the scale of the halfs of cache c.
inline float linkScale(const Caches& caches, std::uint32_t c) {
    return std::ldexp(1.f, -caches.linkExponent[c]);
}

// The sums of lightCaches for the caches [begin, end), from radiosity as withLuma stores it, on one
// thread, with the widest vectors that this machine has. The order of a cache's sums depends on the
// machine's vectors, so results of two kinds of machine agree only up to rounding.

/// Lights caches with links of LinkStorage::Rtp, one link per lane. Whole vectors of links to nodes
/// without light are skipped, which changes no sum. Returns the number of links skipped.
std::size_t lightCones(const Caches& caches, LinkEnds ends, const std::vector<glm::vec4>& radiosity,
                       LightBands bands, std::uint32_t begin, std::uint32_t end, glm::vec3* sh);

/// Lights caches with links of LinkStorage::Sh, one coefficient per lane. Links without light are
/// not skipped: memory brings their coefficients with the others', and finding them takes longer
/// than summing them.
void lightHarmonics(const Caches& caches, LinkEnds ends, const std::vector<glm::vec4>& radiosity,
                    LightBands bands, LinkHalfs halfs, std::uint32_t begin, std::uint32_t end,
                    glm::vec3* sh);

} // namespace limn
