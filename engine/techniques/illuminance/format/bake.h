// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/scene.h"
#include "engine/techniques/illuminance/format/surfel_arrays.h"
#include "shaders/shared/grid_lookup.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

/// The senders as one binary tree. Nodes [0, surfels) are the surfels, then [surfels, surfels +
/// sky) the sky cells, then inner nodes, every parent after its children; the last node is the
/// root.
struct ClusterTree {
    std::uint32_t surfels = 0, skyCells = 0;
    std::vector<std::uint32_t> left,
        right;                           ///< per inner node, children; index - (surfels + skyCells)
    std::vector<float> leftWeight;       ///< share of the left child in its parent, [0, 1]
    std::vector<std::uint32_t> parent;   ///< per node; the root's is ~0
    std::vector<glm::vec3> skyDirection; ///< unit, per sky cell

    std::uint32_t leaves() const { return surfels + skyCells; }
    std::uint32_t size() const { return leaves() + std::uint32_t(left.size()); }
    bool operator==(const ClusterTree&) const = default;
};

/// One link in runtime projection: `node` sends its radiosity B to the cache through a cone, which
/// adds B * transport * cone(u, direction) / (cone's solid angle) to the cache's SH.
/// Jendersie, Kuri, Grosch. Real-Time Global Illumination Using Precomputed Illuminance Composition
/// with Chrominance Compression. 2016
struct Link {
    std::uint32_t node;
    std::uint16_t octX, octY; ///< direction to the sender, octahedral, 16-bit snorm
    std::uint16_t u;          ///< half: 1 - cos of the cone's half-angle
    std::uint16_t transport;  ///< half: visible solid angle / pi [1], times the cache's scale

    bool operator==(const Link&) const = default;
};
static_assert(sizeof(Link) == 12);

/// Directions from which a cache gathers. Hemisphere: those above one side of a surface. Grid: all
/// directions around a point in the air.
enum class CacheKind : std::uint8_t { Hemisphere, Grid };

/// Points at which radiance is gathered: first lightmap texels, then surfel caches, which only
/// surfels read and which lie in texels that no lookup needs, then grid cells.
struct Caches {
    std::uint32_t lightmapCount = 0; ///< surfel caches included
    std::vector<CacheKind> kind;
    std::vector<glm::vec3> position;  ///< world
    std::vector<glm::vec3> normal;    ///< unit geometric normal of its side; 0 for Grid
    std::vector<std::uint32_t> texel; ///< lightmap: y * width + x; grid: cell index
    /// size()+1 offsets into the links. Links of a cache to nodes with nothing but sky come last.
    std::vector<std::uint32_t> linkBegin;
    /// A cache's halfs are scaled by 2^linkExponent, which brings the largest into [2^14, 2^15), so
    /// that even a link of 2^-28 of that is not denormal. 0 for caches without links.
    std::vector<std::int8_t> linkExponent;
    std::vector<Link> links; ///< LinkStorage::Rtp; else empty
    /// LinkStorage::Sh, else empty: the node of each link, and the SH that a radiosity of 1 at that
    /// node adds to the cache: bands^2 halfs per link, times the cache's scale.
    std::vector<std::uint32_t> shNode;
    std::vector<std::uint16_t> shCoefficients;
    /// An invalid cache has no links and takes the mean of these valid caches, with weights that
    /// sum to 1 (no sources where no cache is valid). Valid caches have no sources. fillBegin has
    /// size()+1 offsets.
    std::vector<std::uint32_t> fillBegin;
    std::vector<std::uint32_t> fillSource;
    std::vector<float> fillWeight;

    std::size_t size() const { return position.size(); }
    std::size_t linkCount() const { return links.size() + shNode.size(); }
    bool operator==(const Caches&) const = default;
};

struct BakeCounts {
    std::uint64_t triangles = 0, surfels = 0, clusters = 0, caches = 0, invalidCaches = 0,
                  links = 0, rays = 0;
    bool operator==(const BakeCounts&) const = default;
};

/// Number of depths around each of the grid's cells.
inline constexpr std::uint32_t kDepthsPerCell = GRID_DEPTH_SIDE * GRID_DEPTH_SIDE;

/// Version of what the stages of a bake compute. Raise it whenever a change of one makes the light
/// of bakes that were made before worse than that of new ones. Files without it count as 0.
inline constexpr std::uint32_t kBakerVersion = 3;

/// Everything that relighting needs. The same document gives the same bytes at any number of
/// threads.
struct Bake {
    BakeSettings settings;
    std::uint32_t baker = 0; ///< kBakerVersion of the program that made it; not part of the hash
    std::uint64_t sceneHash = 0; ///< bakeInputHash() of the baked scene
    LightmapLayout lightmap;
    glm::uvec3 gridSize{0};
    Bounds gridBounds;
    std::vector<std::uint16_t> gridDepth; ///< kDepthsPerCell per cell, see field/grid_depth.h
    Surfels surfels;
    ClusterTree tree;
    Caches caches;
    BakeCounts counts;
    std::vector<std::pair<std::string, double>>
        seconds; ///< per stage in order; not part of the hash
    /// Stages found in the store, of which `seconds` says nothing. Not in the hash or the file.
    std::vector<std::string> keptStages;
    /// Messages that say what was recomputed and why: "2 instances moved: 1 204 of 10 585 caches
    /// re-traced". Not part of the hash or the file.
    std::vector<std::string> notes;

    /// Hash of everything but `baker`, `counts`, `seconds`, `keptStages` and `notes`. It is equal
    /// for equal documents, whatever the stage store held.
    std::uint64_t hash() const;
};

/// Hash of everything a bake reads: geometry, instances, alpha masks, sidedness, settings. Excludes
/// lights, albedo, emission and the places of dynamic instances.
std::uint64_t bakeInputHash(const Scene& scene);

} // namespace limn
