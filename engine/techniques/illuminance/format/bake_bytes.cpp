// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/format/bake_bytes.h"

#include "engine/techniques/illuminance/format/link_storage.h"
#include "engine/techniques/illuminance/format/sky_cells.h"

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

std::uint64_t linkBytes(const BakeSettings& s, std::uint64_t caches, double links) {
    const Caches c;
    return (caches + 1) * kBytesPerEntry(c.linkBegin) + caches * kBytesPerEntry(c.linkExponent) +
           std::uint64_t(double(caches) * links) * bytesPerLink(s.storage, s.bands);
}

BakeBytes bytesOf(const Bake& bake) {
    const ClusterTree& t = bake.tree;
    const Caches& c = bake.caches;
    BakeBytes b;
    b.surfels = surfelArrays(bake.surfels, kBytes) +
                kBytes(bake.surfels.lightPoints, bake.surfels.lightNormals);
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
    b.surfels = surfels * (surfelArrays({}, kBytesPerEntry) + kLightPoints * 2 * sizeof(glm::vec3));
    b.clusters = inner * innerNodeArrays(t, kBytesPerEntry) +
                 (leaves + inner) * kBytesPerEntry(t.parent) +
                 kSkyCells * kBytesPerEntry(t.skyDirection);
    b.links = linkBytes(settings, caches, settings.links);
    b.caches = caches * cacheArrays(c, kBytesPerEntry) + (caches + 1) * kBytesPerEntry(c.fillBegin);
    b.caches += std::uint64_t(settings.grid.x) * settings.grid.y * settings.grid.z *
                kDepthsPerCell * sizeof(std::uint16_t);
    return b;
}

} // namespace limn
