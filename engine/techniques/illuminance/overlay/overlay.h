// SPDX-License-Identifier: MIT
#pragma once

#include "engine/overlay/overlay_data.h"
#include "engine/overlay/overlay_kind.h"
#include "engine/techniques/illuminance/format/bake.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace limn {

/// Overlays that can be drawn over a picture to inspect a bake.
enum class Overlay : std::uint32_t {
    None,
    Surfels,       ///< colour: albedo
    SurfelNormals, ///< colour: normal
    SurfelOwners,  ///< colour: instance
    Clusters,      ///< surfels, colour: the cluster at a depth of the tree
    Links,         ///< surfels that a cache is linked with, colour: weight
    Caches,        ///< colour: validity
    Charts,        ///< surfaces, colour: chart
    Density,       ///< surfaces, colour: texels per metre
    Overlap,       ///< surfaces, colour: texels used more than once
    LitSurfels,    ///< colour: radiosity
    LitClusters,   ///< surfels, colour: radiosity of the cluster at a depth of the tree
    Dependencies,  ///< surfels, colour: share of their object in the light of another
    Lobes,         ///< the lit caches' spherical harmonics, colour: the light's own
};

/// The overlays by their number in Overlay.
inline constexpr std::array<OverlayKind, 14> kOverlays = {
    {{"none", "No overlay", "The picture alone"},
     {.name = "surfels",
      .label = "Surfels",
      .tooltip = "Samples of the surfaces that send light, in their albedo",
      .showsMaterials = true},
     {"surfel-normals", "Surfel normals", "Surfels in the colour of the side they stand for"},
     {"surfel-owners", "Surfel owners", "Surfels in one colour per instance"},
     {.name = "clusters",
      .label = "Clusters",
      .tooltip = "Surfels in one colour per cluster at a depth of the tree",
      .hasDepth = true},
     {.name = "links",
      .label = "Link cut",
      .tooltip = "The clusters that light one cache; click a surface to pick the cache",
      .pick = OverlayPick::Required,
      .describesPick = true},
     {"caches", "Caches", "Where light is gathered; magenta: invalid, filled from others"},
     {"charts", "UV charts", "Pieces of surface that lie together in the lightmap"},
     {"density", "Texel density", "Lightmap texels per metre"},
     {"overlap", "UV overlap", "Lightmap texels that more than one piece of surface uses"},
     {.name = "lit-surfels",
      .label = "Lit surfels",
      .tooltip = "What each surfel sends: its light times its albedo",
      .showsLight = true},
     {.name = "lit-clusters",
      .label = "Lit clusters",
      .tooltip = "What the clusters at a depth of the tree send",
      .showsLight = true,
      .hasDepth = true},
     {.name = "dependencies",
      .label = "Dependencies",
      .tooltip = "Which objects light the selected one, by their share of its bounced light; click "
                 "an object to select it",
      .showsLight = true,
      .pick = OverlayPick::Required,
      .ofObject = true},
     {.name = "lobes",
      .label = "SH lobes",
      .tooltip = "Light that reaches the caches from each side, as its harmonics have it; "
                 "orange: below zero",
      .showsLight = true,
      .pick = OverlayPick::Optional}}};

struct OverlayOptions {
    Overlay kind = Overlay::None;
    std::uint32_t depth = 6;   ///< of Clusters and LitClusters; 0: the root
    std::uint32_t cache = ~0u; ///< of Links, Lobes and Dependencies; ~0: none picked

    bool operator==(const OverlayOptions&) const = default;
};

/// The light of a lit bake.
struct LitBake {
    std::vector<glm::vec4> radiosity; ///< per node of the tree, RGB in xyz [W m^-2]
    std::vector<glm::vec3> cacheSh;   ///< bands^2 per cache [W m^-2 sr^-1]
    int bands = 0;
};

/// Builds the overlay of a bake. `scene` is the one that was baked; its materials may be newer.
/// Overlay::None gives nothing to draw; a kind with OverlayKind::showsLight gives only a note
/// without `lit`.
OverlayData makeOverlay(const Bake& bake, const Scene& scene, const OverlayOptions& options,
                        const LitBake* lit = nullptr);

/// One disc per surfel. `colors`: sRGB-encoded, one per surfel.
std::vector<OverlayMark> surfelMarks(const Surfels& surfels, const std::vector<glm::vec3>& colors);

/// Depth of the deepest leaf of the tree; the root's is 0.
std::uint32_t treeDepth(const ClusterTree& tree);

/// Per leaf, the node that represents it when the tree is cut at `depth`: its ancestor at that
/// depth, or the leaf itself if it lies higher.
std::vector<std::uint32_t> clustersAtDepth(const ClusterTree& tree, std::uint32_t depth);

/// Whether a cache has links. An invalid cache has none: it sees nothing but walls and copies
/// others.
inline bool isValid(const Caches& caches, std::uint32_t cache) {
    return caches.linkBegin[cache + 1] > caches.linkBegin[cache];
}

} // namespace limn
