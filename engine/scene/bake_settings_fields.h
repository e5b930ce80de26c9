// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/bake_setting_names.h"
#include "engine/scene/bake_settings.h"
#include "engine/scene/setting.h"

namespace limn {

/// Setting::group of the lightmap's settings, and the last group of all.
inline constexpr int kLightmapGroup = 2, kLastSettingGroup = kLightmapGroup;

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
           .tooltip = "Clusters of surfels that each cache listens to. More: more accurate, slower "
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
           .help = "Wanted number of lightmap caches",
           .tooltip = "About how many texels gather light",
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
           .help = "Where surfels lie",
           .tooltip = "Where surfels lie. Relaxed: Halton points, then spread evenly. Halton and "
                      "random are there to compare"},
          s.placement, SettingChoices{kPlacementNames, kPlacementLabels});
    visit({.key = "linker",
           .flag = "--linker",
           .label = "Linker",
           .help = "How caches find what they see",
           .tooltip = "How a cache finds what it sees. Gather: rays that leave it. Form factor: a "
                      "ray towards every surfel, many times slower; there to compare",
           .group = 1},
          s.linker, SettingChoices{kLinkerNames, kLinkerLabels});
    visit({.key = "cut",
           .flag = "--cut",
           .label = "Cut",
           .help = "Which clusters caches link",
           .tooltip = "Which clusters a cache links. Detail: those whose differences inside would "
                      "change its light most; hard caches get more links, easy ones fewer. Solid "
                      "angle: those that look largest, the same number for every cache",
           .group = 1},
          s.cut, SettingChoices{kCutNames, kCutLabels});
    visit({.key = "storage",
           .flag = "--storage",
           .label = "Link storage",
           .help = "How links are kept: rtp is small, sh quicker to light in few bands",
           .tooltip = "How links are kept. Cones (RTP): 12 bytes each, turned into SH whenever "
                      "light changes. SH: turned once by the bake, 4 + 2 l\u00b2 bytes each. Both "
                      "give the same light",
           .group = 1},
          s.storage, SettingChoices{kStorageNames, kStorageLabels});
    visit({.key = "chromaBands",
           .flag = "--chroma-bands",
           .label = "Chroma bands",
           .help = "SH bands of the lit caches' chrominance; 0: as many as --bands",
           .tooltip = "Bands that keep their colour; what lies above is grey. Fewer: quicker to "
                      "relight. 0: all of them"},
          s.chromaBands, SettingRange{0, 8});
    visit({.key = "clustering",
           .flag = "--clustering",
           .label = "Clustering",
           .help = "How surfels are joined",
           .tooltip = "How surfels are joined into clusters. Agglomerative: the closest two, again "
                      "and again; slower. Kd-tree: halved at medians",
           .group = 1},
          s.clustering, SettingChoices{kClusteringNames, kClusteringLabels});
    visit({.key = "clusterNormalWeight",
           .flag = "--cluster-normal-weight",
           .label = "Normal weight (C_n)",
           .help = "C_n, weight of normals in the clusters' metric",
           .tooltip = "How much clusters keep to surfels that face the same way. More: flatter "
                      "clusters",
           .group = 1},
          s.clusterNormalWeight, SettingRange{0, 100});
    visit({.key = "clusterBalanceWeight",
           .flag = "--cluster-balance-weight",
           .label = "Balance weight (C_b)",
           .help = "C_b, weight of equal areas in it; agglomerative only",
           .tooltip = "How much clusters of like area are joined first. More: a tree of less depth",
           .group = 1,
           .applies = s.clustering == Clustering::Agglomerative},
          s.clusterBalanceWeight, SettingRange{0, 100});
    visit({.key = "grid",
           .flag = "--grid",
           .label = "Grid (cells)",
           .help = "Cells of the grid caches, XxYxZ",
           .tooltip = "Cells along X, Y, Z that light what has no lightmap; 0 0 0: chosen from the "
                      "scene's size",
           .group = kLightmapGroup},
          s.grid, SettingRange{0, 256, 1});
}

} // namespace limn
