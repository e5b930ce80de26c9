// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/memory_budget.h"
#include "engine/core/progress.h"
#include "engine/core/result.h"
#include "engine/lightmap/lightmap_layout.h"
#include "engine/scene/scene.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace limn {

class StageStore;

/// Sample points of the static surfaces that stand for all bounced light. Structure of arrays,
/// world space.
struct Surfels {
    std::vector<glm::vec3> position;
    std::vector<glm::vec3> normal; ///< unit, of the side it stands for: of the triangle while
                                   ///< baking, in a bake of the vertices, for the light it gets
    std::vector<float> area;       ///< [m^2], > 0; they sum to the area of the lit sides
    std::vector<std::uint32_t> instance; ///< index into Scene::instances
    std::vector<std::uint32_t> triangle; ///< of the instance's mesh
    std::vector<glm::vec2> barycentric;  ///< (u, v), weights (1-u-v, u, v)
    /// Where it reads bounced light: four caches with bilinear weights; ~0: none.
    std::vector<glm::uvec4> cache;
    std::vector<glm::vec4> cacheWeight;

    std::size_t size() const { return position.size(); }
    bool operator==(const Surfels&) const = default;
};

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

/// One link, runtime projection: `node` sends its radiosity B to the cache through a cone.
/// The cache's SH grow by B * transport * cone(u, direction) / (cone's solid angle).
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

/// What a cache sees. Hemisphere: all before one side of a surface. Grid: all around a point in the
/// air.
enum class CacheKind : std::uint8_t { Hemisphere, Grid };

/// Where radiance is gathered: texels of the lightmap first, then caches of surfels' own, in texels
/// that no lookup needs, then cells of the grid.
struct Caches {
    std::uint32_t lightmapCount = 0; ///< surfels' own included
    std::vector<CacheKind> kind;
    std::vector<glm::vec3> position;  ///< world
    std::vector<glm::vec3> normal;    ///< unit geometric normal of its side; 0 for Grid
    std::vector<std::uint32_t> texel; ///< lightmap: y * width + x; grid: cell index
    /// size()+1 offsets into its links; those to nothing but sky come last.
    std::vector<std::uint32_t> linkBegin;
    /// The scale of a cache's halfs is 2^linkExponent: its largest one lies in [2^14, 2^15), so
    /// that not even a link 2^-28 of that is denormal. 0 for caches without links.
    std::vector<std::int8_t> linkExponent;
    std::vector<Link> links; ///< LinkStorage::Rtp; else empty
    /// LinkStorage::Sh, else empty: the node of each link, and what its radiosity of 1 adds to the
    /// cache's SH, bands^2 halfs per link, times the cache's scale.
    std::vector<std::uint32_t> shNode;
    std::vector<std::uint16_t> shCoefficients;
    /// An invalid cache has no links and copies these valid ones, weights summing to 1 (none where
    /// no cache is valid); fillBegin has size()+1 offsets. Valid caches have none.
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

/// Everything relighting needs. Same document, same bytes, at any number of threads.
struct Bake {
    BakeSettings settings;
    std::uint64_t sceneHash = 0; ///< bakeInputHash of what it was made from
    LightmapLayout lightmap;
    glm::uvec3 gridSize{0};
    Bounds gridBounds;
    std::vector<std::uint16_t> gridDepth; ///< kGridDepthTexels per cell: how far each one sees
    Surfels surfels;
    ClusterTree tree;
    Caches caches;
    BakeCounts counts;
    std::vector<std::pair<std::string, double>>
        seconds; ///< per stage in order; not part of the hash
    /// What was made again and why, for people: "2 instances moved: 1 204 of 10 585 caches
    /// re-traced". Not part of the hash or the file.
    std::vector<std::string> notes;

    /// Of everything but `counts`, `seconds` and `notes`: equal for equal documents, whatever was
    /// known before.
    std::uint64_t hash() const;
};

/// Hash of everything a bake reads: geometry, instances, alpha masks, sidedness, settings. Not
/// lights, albedo, emission, nor where dynamic instances are.
std::uint64_t bakeInputHash(const Scene& scene);

/// Fails on an empty scene, on settings out of range, and when cancelled ("cancelled").
/// Stages reported: charts, surfels, clusters, caches, trace, training, cut. What `store` knows is
/// not made again: the result is the same, and counts.rays is what was traced now. `settings`
/// replace the scene's own. Fails where predictBake() says that it would need more than `memory`.
Result<Bake> bake(const TraceScene& trace, const Progress& progress = {},
                  StageStore* store = nullptr, const BakeSettings* settings = nullptr,
                  const MemoryBudget& memory = {});

} // namespace limn
