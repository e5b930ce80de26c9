// SPDX-License-Identifier: MIT
#include "engine/relight/dimming.h"

#include "engine/core/parallel.h"
#include "engine/math/packing.h"
#include "engine/relight/link_cone.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kPlanar = 0.99f; // length of the mean normal
constexpr std::size_t kCachesAtOnce = 64;
constexpr std::size_t kLinksAtOnce = 32; // compared

void copyLinks(const Caches& from, LinkHalfs halfs, DimmedLinks& to) {
    to = {};
    to.hidden.resize(from.linkCount());
    to.linksOf.resize(from.size());
    if (!from.shNode.empty()) {
        to.halfs.assign(halfs.begin(), halfs.end());
        return;
    }
    to.cones.lightmapCount = from.lightmapCount;
    to.cones.linkBegin = from.linkBegin;
    to.cones.linkExponent = from.linkExponent;
    to.cones.links = from.links;
}

std::uint16_t dim(std::uint16_t half, float share) {
    return share < 1 ? floatToHalf(halfToFloat(half) * share) : half;
}

struct Writer {
    const Bake& bake;
    LinkHalfs halfs; ///< undimmed
    DimmedLinks& out;

    void write(std::size_t k) {
        const Caches& from = bake.caches;
        const bool cones = from.shNode.empty();
        const float u =
            cones ? halfToFloat(from.links[k].u)
                  : coneOfHarmonics(from, k, from.shCoefficients.size() / from.shNode.size()).u;
        const float share = 1 - float(std::popcount(out.hidden[k])) / float(directionsOf(u));
        if (cones) {
            out.cones.links[k].transport = dim(from.links[k].transport, share);
            return;
        }
        const std::size_t stored = halfs.size() / from.shNode.size();
        for (std::size_t i = k * stored; i < (k + 1) * stored; ++i)
            out.halfs[i] = dim(halfs[i], share);
    }

    /// Takes over what is hidden of a cache's links now.
    void update(std::uint32_t cache, const std::uint16_t* hidden) {
        const std::size_t begin = bake.caches.linkBegin[cache],
                          end = bake.caches.linkBegin[cache + 1];
        for (std::size_t k = begin; k < end; k += kLinksAtOnce) {
            const std::size_t last = std::min(k + kLinksAtOnce, end);
            std::uint16_t* before = out.hidden.data() + k;
            const std::uint16_t* now = hidden + (k - begin);
            if (std::memcmp(before, now, (last - k) * sizeof *now) == 0)
                continue;
            for (std::size_t i = 0; i < last - k; ++i) {
                if (before[i] == now[i])
                    continue;
                out.linksOf[cache] += now[i] != 0 ? 1U : 0U;
                out.linksOf[cache] -= before[i] != 0 ? 1U : 0U;
                before[i] = now[i];
                write(k + i);
            }
        }
    }
};

} // namespace

bool dimsLinks(const Scene& scene) {
    return scene.bake.dimming && std::any_of(scene.instances.begin(), scene.instances.end(),
                                             [](const Instance& i) { return i.dynamic; });
}

std::vector<SenderPlace> senderPlaces(const Surfels& surfels, const ClusterTree& tree) {
    std::vector<SenderPlace> places(tree.size());
    std::vector<glm::vec3> normals(tree.size(), glm::vec3(0)); // means
    for (std::uint32_t s = 0; s < tree.surfels; ++s) {
        places[s].centre = surfels.position[s];
        places[s].radius = std::sqrt(surfels.area[s] / std::numbers::pi_v<float>);
        places[s].normal = normals[s] = surfels.normal[s];
    }
    for (std::uint32_t s = tree.surfels; s < tree.leaves(); ++s)
        places[s].radius = std::numeric_limits<float>::infinity();
    for (std::uint32_t k = 0; k < tree.left.size(); ++k) {
        const std::uint32_t l = tree.left[k], r = tree.right[k];
        SenderPlace& p = places[tree.leaves() + k];
        const float w = tree.leftWeight[k];
        if (std::isinf(places[l].radius) || std::isinf(places[r].radius)) {
            p.radius = std::numeric_limits<float>::infinity();
            continue;
        }
        p.centre = glm::mix(places[r].centre, places[l].centre, w);
        p.radius = std::max(glm::distance(p.centre, places[l].centre) + places[l].radius,
                            glm::distance(p.centre, places[r].centre) + places[r].radius);
        const glm::vec3 n = normals[tree.leaves() + k] = glm::mix(normals[r], normals[l], w);
        const float length = glm::length(n);
        p.normal = length > kPlanar ? n / length : glm::vec3(0);
    }
    return places;
}

void dimLinks(const LinksAndBlockers& scene, LinkHalfs halfs, DimmedLinks& dimmed) {
    const Caches& caches = scene.bake.caches;
    if (scene.blockers.empty()) {
        dimmed = {};
        return;
    }
    if (halfs.empty())
        halfs = caches.shCoefficients;
    if (dimmed.hidden.empty())
        copyLinks(caches, halfs, dimmed);
    Writer writer{scene.bake, halfs, dimmed};
    parallelRanges(caches.size(), kCachesAtOnce, [&](std::size_t begin, std::size_t end) {
        const std::uint32_t first = caches.linkBegin[begin];
        std::vector<std::uint16_t> hidden(caches.linkBegin[end] - first);
        findHiddenLinks(scene, std::uint32_t(begin), std::uint32_t(end), hidden.data());
        for (std::size_t c = begin; c < end; ++c)
            writer.update(std::uint32_t(c), hidden.data() + (caches.linkBegin[c] - first));
    });
    dimmed.caches = 0;
    dimmed.links = 0;
    for (const std::uint32_t links : dimmed.linksOf) {
        dimmed.caches += links > 0 ? 1 : 0;
        dimmed.links += links;
    }
}

} // namespace limn
