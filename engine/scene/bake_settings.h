// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

namespace limn {

/// Where surfels lie on their triangles: at Halton points, then spread evenly; at Halton points; at
/// pseudo-random ones (the paper's Figure 3 compares the latter two).
enum class SurfelPlacement : std::uint8_t { Relaxed, Halton, Random };

/// How surfels are joined into clusters: the closest two by the paper's metric, again and again, or
/// by halving at medians.
enum class Clustering : std::uint8_t { Agglomerative, KdTree };

/// How a cache finds what it sees: by rays that leave it, or, as the paper has it, by a ray towards
/// every surfel.
enum class Linker : std::uint8_t { Gather, FormFactor };

/// Which clusters a cache links: those whose inner differences would change its light most, as
/// many links as it is worth; or, as the paper has it, n_L of the largest visible solid angle.
enum class CutCriterion : std::uint8_t { Detail, SolidAngle };

/// How links are kept. Rtp: as cones whose spherical harmonics are worked out while lighting, 12
/// bytes each. Sh: as those spherical harmonics, 4 + 2 bands^2 bytes each. They give the same light
/// up to the rounding of halfs.
enum class LinkStorage : std::uint8_t { Rtp, Sh };

/// What a bake depends on besides the scene. Part of the document. Defaults suit a room or a small
/// building: what a texel misses weighs more there than what a link or a ray does, so texels come
/// first, and links and rays share what is left of the time.
struct BakeSettings {
    std::uint32_t surfels = 32768; ///< n_S, target over the scene; [64, 1 << 20]
    std::uint32_t links = 64;      ///< n_L per cache, a mean with CutCriterion::Detail; [1, 4096]
    std::uint32_t bands = 3;       ///< SH bands of the caches; [2, 8]
    std::uint32_t rays = 256;      ///< R per cache; [16, 65536]
    std::uint32_t lightmapCaches =
        36000;                       ///< target count of lightmap caches; 0 with texelsPerMetre > 0
    float texelsPerMetre = 0;        ///< > 0: fixes the texel density instead
    glm::uvec3 grid{0};              ///< cells of the grid caches; 0: chosen from the bounds
    std::uint32_t maxBounces = 1000; ///< relighting stops earlier once converged
    bool dimming = true;             ///< dynamic objects keep bounced light off what is behind them

    SurfelPlacement placement = SurfelPlacement::Relaxed;
    Linker linker = Linker::Gather;
    CutCriterion cut = CutCriterion::Detail;

    LinkStorage storage = LinkStorage::Rtp;
    /// Bands of the lit caches' chrominance, [0, 8]; 0, or more than `bands`: as many as `bands`.
    /// With 1 surfaces show half of the bounced light's colour.
    std::uint32_t chromaBands = 0;

    Clustering clustering = Clustering::Agglomerative;
    float clusterNormalWeight = 0.1f;   ///< C_n of the clusters' metric; [0, 100]
    float clusterBalanceWeight = 0.02f; ///< C_b, of agglomerative clusters only; [0, 100]

    bool operator==(const BakeSettings&) const = default;
};

/// The number of bands that `chromaBands` stands for, [1, bands].
inline std::uint32_t chromaBandsOf(const BakeSettings& s) {
    return s.chromaBands == 0 || s.chromaBands > s.bands ? s.bands : s.chromaBands;
}

/// So few bounces, or fewer, are taken as they are asked for (BakeSettings::maxBounces): whenever
/// something changes they begin from no bounced light at all. More go on from the light that was.
inline constexpr std::uint32_t kFewBounces = 8;

/// Which of the settings is out of its range, in words; empty: none.
std::string settingsDefect(const BakeSettings& settings);

/// Sets the setting of that key to what `text` says, and to 0 the one that it replaces. Says what
/// is wrong with the text and changes nothing; empty: it is set. Precondition: there is such a
/// setting.
std::string setBakeSetting(BakeSettings& settings, std::string_view key, const std::string& text);

/// Counts that go together.
struct BakePreset {
    const char* name; ///< as on the command line
    std::uint32_t surfels, links, rays, lightmapCaches;

    /// Its counts are those of the settings.
    bool describes(const BakeSettings& s) const {
        return s.surfels == surfels && s.links == links && s.rays == rays &&
               s.lightmapCaches == lightmapCaches && s.texelsPerMetre == 0;
    }
    void applyTo(BakeSettings& s) const {
        s.surfels = surfels;
        s.links = links;
        s.rays = rays;
        s.lightmapCaches = lightmapCaches;
        s.texelsPerMetre = 0;
    }
};
inline constexpr std::array<BakePreset, 3> kBakePresets = {{{"draft", 16384, 64, 128, 10000},
                                                            {"medium", 32768, 64, 256, 36000},
                                                            {"high", 131072, 128, 256, 160000}}};

} // namespace limn
