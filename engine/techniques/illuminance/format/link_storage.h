// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"

#include <cstdint>
#include <span>
#include <vector>

namespace limn {

/// A link before it is packed: a node of the sender tree, as a cone of directions seen from a
/// cache.
struct Cone {
    std::uint32_t node;
    glm::vec3 direction; ///< unit
    float u;             ///< 1 - cos(half-angle), [0, 2]
    float transport;     ///< visible solid angle / pi, > 0
    float irradiance; ///< exact, at unit radiosity: the rays' sum of solid angle / pi times cosine
};

/// The packed links of one cache, as the fields of Caches of the same names.
struct PackedLinks {
    std::int8_t linkExponent = 0;
    std::vector<Link> links;
    std::vector<std::uint32_t> shNode;
    std::vector<std::uint16_t> shCoefficients;
};

/// Packs a cache's links for LinkStorage::Rtp.
PackedLinks packCones(std::span<const Cone> cones);

/// Packs a cache's links for LinkStorage::Sh. `coefficients` has bands^2 values for each of
/// `nodes`, link after link: the SH that a radiosity of 1 adds to the cache.
PackedLinks packHarmonics(int bands, std::vector<std::uint32_t> nodes,
                          std::span<const float> coefficients);

/// Replaces the links of `caches` by these, one entry per cache.
void joinLinks(std::span<const PackedLinks> packed, Caches& caches);

/// Bytes of one link.
std::uint64_t bytesPerLink(LinkStorage storage, std::uint32_t bands);

/// The part of a link that both storages have in common.
struct LinkWeight {
    std::uint32_t node;
    float transport; ///< visible solid angle / pi [1]
};

/// Link k of cache c; k lies in [linkBegin[c], linkBegin[c + 1]).
LinkWeight linkWeight(const Caches& caches, std::uint32_t c, std::uint32_t k);

/// Writes the bands^2 coefficients that a radiosity of 1 at that link's node adds to the cache's
/// SH. `bands` is at most the number that links of LinkStorage::Sh have.
void expandLink(const Caches& caches, std::uint32_t c, std::uint32_t k, int bands,
                float* coefficients);

} // namespace limn
