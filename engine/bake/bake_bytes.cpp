// SPDX-License-Identifier: MIT
#include "engine/bake/bake_bytes.h"

#include "engine/bake/cache_points.h"
#include "engine/bake/cluster_tree.h"
#include "engine/bake/grid_depth.h"
#include "engine/bake/link_storage.h"
#include "engine/bake/seen_patches.h"
#include "engine/scene/triangle_geometry.h"

#include <algorithm>

namespace limn {

namespace {

constexpr auto kBytes = [](const auto&... arrays) {
    return ((std::uint64_t(arrays.size()) * sizeof arrays[0]) + ... + 0);
};
constexpr auto kBytesPerEntry = [](const auto&... arrays) {
    return (std::uint64_t(sizeof arrays[0]) + ... + 0);
};

// The arrays with one entry per surfel, inner node, node, and cache.

template <class Use>
std::uint64_t surfelArrays(const Surfels& s, Use use) {
    return use(s.position, s.normal, s.area, s.instance, s.triangle, s.barycentric, s.cache,
               s.cacheWeight);
}

template <class Use>
std::uint64_t innerNodeArrays(const ClusterTree& t, Use use) {
    return use(t.left, t.right, t.leftWeight);
}

template <class Use>
std::uint64_t cacheArrays(const Caches& c, Use use) {
    return use(c.kind, c.position, c.normal, c.texel);
}

} // namespace

BakeBytes bytesOf(const Bake& bake) {
    const ClusterTree& t = bake.tree;
    const Caches& c = bake.caches;
    BakeBytes b;
    b.surfels = surfelArrays(bake.surfels, kBytes);
    b.clusters = innerNodeArrays(t, kBytes) + kBytes(t.parent, t.skyDirection);
    b.links = kBytes(c.linkBegin, c.linkExponent, c.links, c.shNode, c.shCoefficients);
    b.caches = cacheArrays(c, kBytes) + kBytes(c.fillBegin, c.fillSource, c.fillWeight) +
               kBytes(bake.gridDepth);
    return b;
}

BakeBytes bytesOf(const Bake& bake, LinkStorage storage, std::uint32_t bands) {
    const Caches& c = bake.caches;
    BakeBytes b = bytesOf(bake);
    b.links = kBytes(c.linkBegin, c.linkExponent) + c.linkCount() * bytesPerLink(storage, bands);
    return b;
}

BakeBytes predictBytes(const BakeSettings& settings, std::uint64_t surfels, std::uint64_t caches) {
    const ClusterTree t;
    const Caches c;
    const std::uint64_t leaves = surfels + kSkyCells, inner = leaves - 1;
    BakeBytes b;
    b.surfels = surfels * surfelArrays({}, kBytesPerEntry);
    b.clusters = inner * innerNodeArrays(t, kBytesPerEntry) +
                 (leaves + inner) * kBytesPerEntry(t.parent) +
                 kSkyCells * kBytesPerEntry(t.skyDirection);
    b.links = (caches + 1) * kBytesPerEntry(c.linkBegin) +
              caches * (kBytesPerEntry(c.linkExponent) +
                        settings.links * bytesPerLink(settings.storage, settings.bands));
    b.caches = caches * cacheArrays(c, kBytesPerEntry) + (caches + 1) * kBytesPerEntry(c.fillBegin);
    b.caches += std::uint64_t(settings.grid.x) * settings.grid.y * settings.grid.z *
                kGridDepthTexels * sizeof(std::uint16_t);
    return b;
}

std::uint64_t roughPeak(const BakeSettings& settings, std::uint64_t caches) {
    // What grows with each of them, on top of what the result holds: hits and their sorting, cuts
    // being chosen, patches and training light, points and texels.
    constexpr double kPerRay = 14, kPerLink = 48, kPerSurfel = 4000, kPerCache = 4600;
    const double perCache = kPerRay * settings.rays + kPerLink * settings.links + kPerCache;
    const double bytes = double(caches) * perCache + kPerSurfel * double(settings.surfels) +
                         double(predictBytes(settings, settings.surfels, caches).total());
    return std::uint64_t(std::min(bytes, 1e18));
}

std::uint64_t expectedCaches(const Scene& scene) {
    const BakeSettings& s = scene.bake;
    LightmapLayout layout; // only as to which instances have a lightmap
    double area = 0, texels = s.lightmapCaches;
    for (const Instance& i : scene.instances) {
        layout.instances.emplace_back();
        if (i.dynamic)
            continue;
        layout.instances.back().uv.emplace_back(0);
        if (s.texelsPerMetre > 0)
            area += worldArea(scene, i) * (isTwoSided(scene.materialOf(i)) ? 2 : 1);
    }
    if (s.texelsPerMetre > 0)
        texels = area * double(s.texelsPerMetre) * double(s.texelsPerMetre);
    const glm::uvec3 grid = chooseGridSize(scene, layout, s);
    texels += texels / kCachesPerOwn;
    return std::uint64_t(std::min(texels, 1e15)) + std::uint64_t(grid.x) * grid.y * grid.z;
}

} // namespace limn
