// SPDX-License-Identifier: MIT
#pragma once

#include "engine/runtime/limn_runtime.h"

#include <cstddef>
#include <cstdint>

namespace limn::runtime {

inline constexpr std::uint32_t kMajor = 2, kMaxBands = 8, kDepthTexels = 256, kMaxBoxDepth = 60,
                               kMaxLightPoints = 16;
inline constexpr float kMaxLight = 1e10f, kMaxAlbedo = 0.99f;

/// The section DIMS.
struct Dims {
    std::uint32_t surfels, skyCells, innerNodes, caches, lightmapCaches, links, fills, bands,
        chromaBands, materials, lights, lightmapWidth, lightmapHeight, lightmapParts, grid[3],
        triangles, boxes, cutouts, masks, lightPoints, reserved[2];

    std::uint64_t leaves() const { return std::uint64_t(surfels) + skyCells; }
    std::uint64_t nodes() const { return leaves() + innerNodes; }
    std::uint64_t texels() const { return std::uint64_t(lightmapWidth) * lightmapHeight; }
    std::uint32_t cells() const { return caches - lightmapCaches; }
};
static_assert(sizeof(Dims) == 96);

struct Link {
    std::uint32_t node;
    std::int16_t octX, octY;
    std::uint16_t u, transport; ///< halfs
};
static_assert(sizeof(Link) == 12);

/// A node of the occluders' tree, in breadth-first order. count 0: an inner node, whose children
/// are the boxes `first` and `first` + 1. Otherwise a leaf with triangles [first, first + count).
struct Box {
    float lower[3];
    std::uint32_t first;
    float upper[3];
    std::uint32_t count;
};
static_assert(sizeof(Box) == 32);

/// What a triangle with holes has at its corners, and its mask.
struct Cutout {
    struct Corner {
        float u, v, factor;
    } corner[3];
    std::uint32_t mask;
};
static_assert(sizeof(Cutout) == 40);

/// An alpha test.
struct Mask {
    std::uint64_t begin; ///< of its texels
    std::uint32_t size[2], wrap[2];
    std::uint32_t nearest;
    float cutoff;
};
static_assert(sizeof(Mask) == 32);
inline constexpr std::uint32_t kOpaque = ~0U; ///< number of a triangle that is no cutout

/// The section SPAC.
struct Space {
    float gridLower[3], gridUpper[3];
    float magnitude; ///< the power of two above the scene's largest coordinate [m]
    float reserved;
};
static_assert(sizeof(Space) == 32);
static_assert(sizeof(limnrt_light) == 80);

/// An entry of the table of sections.
struct SectionEntry {
    char tag[4];
    std::uint32_t elementSize; ///< [bytes]
    std::uint64_t offset, bytes, hash;
};
static_assert(sizeof(SectionEntry) == 32);

/// The sections of a file, where they lie.
struct TransportView {
    const SectionEntry* sections; ///< the whole table
    std::uint32_t sectionCount, minor;
    Dims dims;
    const Space* space;
    const float *surfelPosition, *surfelNormal, *surfelAlbedo, *surfelEmission, *surfelArea;
    /// Points on the surface whose mean direct light is the surfel's [m], lightPointsEach per
    /// surfel. Those of a file without light points are the surfels' positions.
    const float* lightPoint;
    std::uint32_t lightPointsEach;
    const float* lightNormal; ///< unit, per light point; null: those of the surfels
    const std::uint32_t *surfelMaterial, *surfelInstance, *surfelCache;
    const float* surfelCacheWeight;
    const std::uint32_t* child; ///< left and right of each inner node
    const float* leftWeight;
    const float *skyDirection, *skyRadiance;
    const float *cachePosition, *cacheNormal;
    const std::uint32_t* linkBegin;
    const std::int8_t* linkExponent;
    const Link* links;
    const std::uint32_t *fillBegin, *fillSource;
    const float* fillWeight;
    const std::uint32_t *partBegin, *partCache; ///< of the lightmap's texels
    const std::uint16_t* partWeight;
    const std::uint16_t* gridDepth;
    const Box* boxes;
    const float* triangles;      ///< three corners each
    const std::uint32_t* cutout; ///< per triangle: its index in `cutouts`, or kOpaque
    const Cutout* cutouts;
    const Mask* masks;
    const std::uint8_t* maskTexels;
    std::size_t maskTexelCount;
    const limnrt_light* lights;
    const char *names, *meta;
    std::size_t nameBytes, metaBytes;
};

/// Where a message goes; `size` may be 0.
struct ErrorText {
    char* text;
    std::size_t size;
};

/// Finds the sections of a file and checks all that reading relies on: hashes (unless they are to
/// be skipped), lengths, indices, orders and ranges. Writes a message and returns false where
/// something is wrong. O(bytes).
bool viewTransport(const void* bytes, std::size_t size, bool skipHashes, TransportView& view,
                   ErrorText error);

/// Same for the contents alone. Writes the section's tag and what is wrong with it.
bool checkContents(const TransportView& view, ErrorText error);

/// Whether a light's numbers are finite and in their ranges.
bool isLight(const limnrt_light& light);

} // namespace limn::runtime
