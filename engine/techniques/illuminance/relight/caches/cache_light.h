// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/ycocg.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/caches/cache_runs.h"
#include "engine/techniques/illuminance/relight/caches/light_links.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Radiosity [W m^-2] as it is stored per node: RGB in xyz, and its luma, which grey bands use, in
/// w.
inline glm::vec4 withLuma(glm::vec3 rgb) {
    return {rgb, toYCoCg(rgb).y};
}

/// Computes the radiosity of the inner nodes as the weighted mean of their children's, in one
/// sweep.
/// `radiosity` has one entry per node, leaves filled in by withLuma.
void pullRadiosity(const ClusterTree& tree, std::vector<glm::vec4>& radiosity);

/// Number of links of the caches that were lit, and of those that were skipped because their
/// senders send no light. Skipping causes no error. Both are the same for any number of threads.
struct LinkCounts {
    std::uint64_t links = 0, skipped = 0;
};

/// Computes the SH of incident radiance of the caches of `runs`, which do not overlap: sh[c *
/// bands^2 + i] = sum over links before ends[c] of B transport g_l(u) Y_i(direction), bands =
/// bands.luma, with links of either storage; empty `halfs` are Caches::shCoefficients. From band
/// bands.chroma on the light is grey: its luma alone, half of which is green. Invalid caches among
/// them are left 0. Jendersie, Kuri, Grosch. Real-Time Global Illumination Using Precomputed
/// Illuminance Composition with Chrominance Compression. 2016
LinkCounts lightCaches(const Caches& caches, LinkEnds ends, const std::vector<glm::vec4>& radiosity,
                       LightBands bands, const CacheRuns& runs, std::vector<glm::vec3>& sh,
                       LinkHalfs halfs = {});

/// Lets the light of the lightmap's caches in `runs` continue below their surfaces
/// (engine/math/horizon.h). Two of the `bands` at least are in colour.
void continueCaches(const Caches& caches, int bands, const CacheRuns& runs,
                    std::vector<glm::vec3>& sh);

/// The first bands^2 halfs of each link of LinkStorage::Sh, packed without the others, because
/// memory is read in whole cache lines. Empty where links are cones.
std::vector<std::uint16_t> firstHalfs(const Caches& caches, int bands);

/// Per cache, the end of its links, and the end of those to more than sky, which alone are read
/// while the sky is black.
std::vector<std::uint32_t> allLinks(const Caches& caches);
std::vector<std::uint32_t> linksBeforeSky(const Caches& caches, const ClusterTree& tree);

/// Makes the bands from bands.chroma on grey.
void dropChroma(LightBands bands, const CacheRuns& runs, std::vector<glm::vec3>& sh);

/// Writes the harmonics of cache c at its place in a field of `stride` texels or cells.
void placeCache(const Caches& caches, const std::vector<glm::vec3>& sh, std::size_t c,
                std::size_t coefficients, std::size_t stride, std::vector<glm::vec4>& out);

/// Fills the invalid caches of the runs from the valid ones that stand in for them.
void fillInvalidCaches(const Caches& caches, int bands, const CacheRuns& runs,
                       std::vector<glm::vec3>& sh);

} // namespace limn
