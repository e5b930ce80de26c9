// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include <glm/vec3.hpp>

namespace limn {

/// How surfels are placed on their triangles: at Halton points that are then spread evenly, at
/// Halton points, or at pseudo-random points (the paper's Figure 3 compares the latter two).
enum class SurfelPlacement : std::uint8_t { Relaxed, Halton, Random };

/// How surfels are clustered: by repeatedly joining the closest pair under the paper's metric, or
/// by splitting at medians.
enum class Clustering : std::uint8_t { Agglomerative, KdTree };

/// How a cache finds what it sees: by tracing rays from the cache, or, as in the paper, by tracing
/// a ray towards every surfel.
enum class Linker : std::uint8_t { Gather, FormFactor };

/// Which clusters a cache links. Detail: those whose inner differences would change its light most,
/// with as many links as the cache is worth. SolidAngle: as in the paper, the n_L with the largest
/// visible solid angle.
enum class CutCriterion : std::uint8_t { Detail, SolidAngle };

/// How links are stored. Rtp: as cones whose spherical harmonics are computed during lighting, 12
/// bytes each. Sh: as those spherical harmonics, 4 + 2 bands^2 bytes each. Both give the same light
/// up to the rounding of halfs.
enum class LinkStorage : std::uint8_t { Rtp, Sh };

/// What a bake depends on besides the scene. Part of the document. The defaults suit a room or a
/// small building: there, missing texels cause larger errors than missing links or rays, so texels
/// get the largest share of the time, and links and rays the rest.
struct BakeSettings {
    std::uint32_t surfels = 32768; ///< n_S, target over the scene; [64, 1 << 20]
    std::uint32_t links = 64;      ///< n_L per cache, a mean with CutCriterion::Detail; [1, 4096]
    std::uint32_t bands = 3;       ///< SH bands of the caches; [2, 8]
    std::uint32_t rays = 256;      ///< R per cache; [16, 65536]
    std::uint32_t lightmapCaches =
        36000;                ///< target count of lightmap caches; 0 with texelsPerMetre > 0
    float texelsPerMetre = 0; ///< > 0: fixes the texel density instead
    glm::uvec3 grid{0};       ///< cells of the grid caches; 0: chosen from the bounds

    SurfelPlacement placement = SurfelPlacement::Relaxed;
    Linker linker = Linker::Gather;
    CutCriterion cut = CutCriterion::Detail;

    LinkStorage storage = LinkStorage::Rtp;
    /// Number of bands of the lit caches' chrominance, [0, 8]; 0, or more than `bands`: equal to
    /// `bands`. With 1 band, surfaces show half of the bounced light's colour.
    std::uint32_t chromaBands = 0;

    Clustering clustering = Clustering::Agglomerative;
    float clusterNormalWeight = 0.1f;   ///< C_n of the clusters' metric; [0, 100]
    float clusterBalanceWeight = 0.02f; ///< C_b, of agglomerative clusters only; [0, 100]

    bool operator==(const BakeSettings&) const = default;
};

/// Number of chrominance bands that `chromaBands` stands for, [1, bands].
inline std::uint32_t chromaBandsOf(const BakeSettings& s) {
    return s.chromaBands == 0 || s.chromaBands > s.bands ? s.bands : s.chromaBands;
}

/// Describes which setting is out of its range; empty if all are valid.
std::string settingsDefect(const BakeSettings& settings);

/// Sets the setting `key` to the value in `text`, and the setting that it replaces to 0. Returns an
/// empty string on success; otherwise a description of what is wrong with the text, and nothing
/// changes. Precondition: the setting exists.
std::string setBakeSetting(BakeSettings& settings, std::string_view key, const std::string& text);

/// A named combination of counts.
struct BakePreset {
    const char* name; ///< as on the command line
    std::uint32_t surfels, links, rays, lightmapCaches;

    /// Whether the settings have this preset's counts.
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
                                                            {"high", 131072, 128, 1024, 160000}}};

} // namespace limn
