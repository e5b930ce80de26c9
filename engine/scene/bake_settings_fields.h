// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/bake_setting_names.h"
#include "engine/scene/bake_settings.h"
#include "engine/scene/setting.h"

namespace limn {

/// Setting::group of the lightmap's settings, of those for research, which are seldom changed, and
/// the last group of all.
inline constexpr int kLightmapGroup = 1, kResearchGroup = 2, kLastSettingGroup = kResearchGroup;

/// Calls visit(setting, value) for a switch and visit(setting, value, range or choices) for any
/// other setting, once for each, in the order of bake files. `s` is a BakeSettings, const or not.
template <class S, class Visit>
void visitBakeSettings(S& s, const Visit& visit) {
    visit({.key = "surfels",
           .flag = "--surfels",
           .label = "Surfels (n_S)",
           .help = "Surfels n_S",
           .tooltip = "Sample points of the surfaces that stand for all bounced light, over the "
                      "whole scene. More: finer light, longer bake, more memory"},
          s.surfels, SettingRange{64, 1 << 20});
    visit({.key = "links",
           .flag = "--links",
           .label = "Links (n_L)",
           .help = "Links per cache n_L",
           .tooltip =
               "Clusters of surfels that each cache gathers from. More: more accurate, slower "
               "to relight"},
          s.links, SettingRange{1, 4096});
    visit({.key = "bands",
           .flag = "--bands",
           .label = "SH bands",
           .help = "SH bands of the caches",
           .tooltip = "Bands of spherical harmonics per cache, l\u00b2 numbers each. 3 for diffuse "
                      "light"},
          s.bands, SettingRange{2, 8});
    visit({.key = "rays",
           .flag = "--rays",
           .label = "Rays per cache",
           .help = "Gather rays per cache",
           .tooltip = "Rays traced from each cache while baking. More: less noise, longer bake"},
          s.rays, SettingRange{16, 65536});
    visit({.key = "lightmapCaches",
           .flag = "--lightmap",
           .label = "Lightmap texels",
           .help = "Target number of lightmap caches",
           .tooltip = "Target number of texels that gather light. Light from emissive surfaces "
                      "adds up to as many where it varies most",
           .replaces = "texelsPerMetre",
           .group = kLightmapGroup,
           .applies = s.texelsPerMetre == 0},
          s.lightmapCaches, SettingRange{0, 1 << 24, 1});
    visit({.key = "texelsPerMetre",
           .flag = "--texels-per-metre",
           .label = "Density (texels/m)",
           .help = "Lightmap density, instead of --lightmap",
           .tooltip = "Lightmap texels per metre of surface [1/m]",
           .group = kLightmapGroup,
           .applies = s.texelsPerMetre > 0},
          s.texelsPerMetre, SettingRange{0, 1e6, 1e-9});
    visit({.key = "placement",
           .flag = "--placement",
           .label = "Placement",
           .help = "How surfels are placed",
           .tooltip =
               "How surfels are placed. Relaxed: at Halton points, then spread evenly. Halton "
               "and random are for comparison"},
          s.placement, SettingChoices{kPlacementNames, kPlacementLabels});
    visit({.key = "linker",
           .flag = "--linker",
           .label = "Linker",
           .help = "How caches find what they see",
           .tooltip =
               "How a cache finds what it sees. Gather: by rays that leave it. Form factor: by "
               "a ray towards every surfel, many times slower; for comparison",
           .group = kResearchGroup},
          s.linker, SettingChoices{kLinkerNames, kLinkerLabels});
    visit({.key = "cut",
           .flag = "--cut",
           .label = "Cut",
           .help = "Which clusters caches link",
           .tooltip = "Which clusters a cache links. Detail: those whose inner differences would "
                      "change its light most; caches of varied light get more links. Solid "
                      "angle: those of the largest solid angle, the same number for every cache",
           .group = kResearchGroup},
          s.cut, SettingChoices{kCutNames, kCutLabels});
    visit({.key = "storage",
           .flag = "--storage",
           .label = "Link storage",
           .help = "How links are stored: rtp is small, sh faster to relight with few bands",
           .tooltip = "How links are stored. Cones (RTP): 12 bytes each, projected to SH whenever "
                      "light changes. SH: projected once by the bake, 4 + 2 l\u00b2 bytes each. "
                      "Both give the same light",
           .group = kResearchGroup},
          s.storage, SettingChoices{kStorageNames, kStorageLabels});
    visit({.key = "chromaBands",
           .flag = "--chroma-bands",
           .label = "Chroma bands",
           .help = "SH bands of the lit caches' chrominance; 0: as many as --bands",
           .tooltip = "Bands that keep their colour; higher bands are grey. Fewer: faster to "
                      "relight. 0: all"},
          s.chromaBands, SettingRange{0, 8});
    visit({.key = "clustering",
           .flag = "--clustering",
           .label = "Clustering",
           .help = "How surfels are clustered",
           .tooltip = "How surfels are clustered. Agglomerative: the closest pair is joined "
                      "repeatedly; slower. Kd-tree: split at medians",
           .group = kResearchGroup},
          s.clustering, SettingChoices{kClusteringNames, kClusteringLabels});
    visit({.key = "clusterNormalWeight",
           .flag = "--cluster-normal-weight",
           .label = "Normal weight (C_n)",
           .help = "C_n, weight of normals in the clusters' metric",
           .tooltip =
               "Weight of the difference of normals. More: clusters of surfels that face the "
               "same direction",
           .group = kResearchGroup},
          s.clusterNormalWeight, SettingRange{0, 100});
    visit({.key = "clusterBalanceWeight",
           .flag = "--cluster-balance-weight",
           .label = "Balance weight (C_b)",
           .help = "C_b, weight of balance in the clusters' metric; agglomerative only",
           .tooltip = "Weight of balance: clusters of similar area are joined first. More: a "
                      "shallower tree",
           .group = kResearchGroup,
           .applies = s.clustering == Clustering::Agglomerative},
          s.clusterBalanceWeight, SettingRange{0, 100});
    visit({.key = "grid",
           .flag = "--grid",
           .label = "Grid (cells)",
           .help = "Cells of the grid caches, XxYxZ",
           .tooltip =
               "Cells along X, Y and Z. They light objects without a lightmap. 0 0 0: chosen "
               "from the size of the scene",
           .group = kLightmapGroup},
          s.grid, SettingRange{0, 256, 1});
}

} // namespace limn
