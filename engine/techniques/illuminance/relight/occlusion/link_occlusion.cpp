// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/occlusion/link_occlusion.h"

#include "engine/core/parallel.h"
#include "engine/math/packing.h"
#include "engine/techniques/illuminance/relight/occlusion/link_cone.h"

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
constexpr std::size_t kCachesAtOnce = 64, kLinksAtOnce = 4096;
constexpr std::size_t kCompared = 32; // links

/// Stores the hidden directions of a cache's links; adds the links for which they changed to
/// `changed`.
void takeHidden(const Caches& caches, std::uint32_t cache, const std::uint16_t* now,
                HiddenLinks& out, std::vector<std::uint32_t>& changed) {
    const std::size_t begin = caches.linkBegin[cache], end = caches.linkBegin[cache + 1];
    for (std::size_t k = begin; k < end; k += kCompared) {
        const std::size_t last = std::min(k + kCompared, end);
        std::uint16_t* before = out.directions.data() + k;
        const std::uint16_t* after = now + (k - begin);
        if (std::memcmp(before, after, (last - k) * sizeof *after) == 0)
            continue;
        for (std::size_t i = 0; i < last - k; ++i) {
            if (before[i] == after[i])
                continue;
            out.linksOf[cache] += after[i] != 0 ? 1U : 0U;
            out.linksOf[cache] -= before[i] != 0 ? 1U : 0U;
            before[i] = after[i];
            changed.push_back(std::uint32_t(k + i));
        }
    }
}

void updateHidden(const LinksAndBlockers& scene, HiddenLinks& hidden) {
    const Caches& caches = scene.bake.caches;
    hidden.directions.resize(caches.linkCount());
    hidden.linksOf.resize(caches.size());
    std::vector<std::vector<std::uint32_t>> changed((caches.size() + kCachesAtOnce - 1) /
                                                    kCachesAtOnce);
    parallelRanges(changed.size(), 1, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint16_t> now;
        for (std::size_t part = begin; part < end; ++part) {
            const auto first = std::uint32_t(part * kCachesAtOnce),
                       last = std::uint32_t(std::min((part + 1) * kCachesAtOnce, caches.size()));
            const std::uint32_t firstLink = caches.linkBegin[first];
            now.resize(caches.linkBegin[last] - firstLink);
            findHiddenLinks(scene, first, last, now.data());
            for (std::uint32_t c = first; c < last; ++c)
                takeHidden(caches, c, now.data() + (caches.linkBegin[c] - firstLink), hidden,
                           changed[part]);
        }
    });
    hidden.changed.clear();
    for (const std::vector<std::uint32_t>& part : changed)
        hidden.changed.insert(hidden.changed.end(), part.begin(), part.end());
    hidden.caches = 0;
    hidden.links = 0;
    for (const std::uint32_t links : hidden.linksOf) {
        hidden.caches += links > 0 ? 1 : 0;
        hidden.links += links;
    }
}

void copyLinks(const Caches& from, LinkHalfs halfs, OccludedLinks& to) {
    if (!from.shNode.empty()) {
        to.halfs.assign(halfs.begin(), halfs.end());
        return;
    }
    to.cones.lightmapCount = from.lightmapCount;
    to.cones.linkBegin = from.linkBegin;
    to.cones.linkExponent = from.linkExponent;
    to.cones.links = from.links;
}

struct Writer {
    const Bake& bake;
    const HiddenLinks& hidden;
    LinkHalfs halfs; ///< unoccluded
    OccludedLinks& out;

    void write(std::size_t k) {
        const Caches& from = bake.caches;
        const float share = openShare(bake, hidden, k);
        if (from.shNode.empty()) {
            out.cones.links[k].transport = occludedHalf(from.links[k].transport, share);
            return;
        }
        const std::size_t stored = halfs.size() / from.shNode.size();
        for (std::size_t i = k * stored; i < (k + 1) * stored; ++i)
            out.halfs[i] = occludedHalf(halfs[i], share);
    }
};

} // namespace

bool occludesLinks(const Scene& scene) {
    return scene.relight.dynamicOcclusion &&
           std::any_of(scene.instances.begin(), scene.instances.end(),
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

bool updateLinkOcclusion(const Bake& bake, const Scene& scene, LinkOcclusion& occlusion) {
    const std::uint64_t now = occludesLinks(scene) ? hashBlockers(scene) : 0;
    if (now == occlusion.blockers)
        return false;
    occlusion.blockers = now;
    if (occlusion.places.empty())
        occlusion.places = senderPlaces(bake.surfels, bake.tree);
    updateHidden({bake, occlusion.places,
                  now != 0 ? sceneBlockers(scene, occlusion.shapes) : std::vector<Blocker>()},
                 occlusion.hidden);
    return true;
}

float openShare(const Bake& bake, const HiddenLinks& hidden, std::size_t k) {
    const Caches& c = bake.caches;
    const float u = c.shNode.empty()
                        ? halfToFloat(c.links[k].u)
                        : coneOfHarmonics(c, k, c.shCoefficients.size() / c.shNode.size()).u;
    return 1 - float(std::popcount(hidden.directions[k])) / float(directionsOf(u));
}

std::uint16_t occludedHalf(std::uint16_t half, float share) {
    return share < 1 ? floatToHalf(halfToFloat(half) * share) : half;
}

void occludeLinks(const Bake& bake, const LinkOcclusion& occlusion, LinkHalfs halfs,
                  OccludedLinks& occluded) {
    if (occlusion.blockers == 0) {
        occluded = {};
        return;
    }
    if (halfs.empty())
        halfs = bake.caches.shCoefficients;
    const HiddenLinks& hidden = occlusion.hidden;
    const bool fresh = occluded.cones.links.empty() && occluded.halfs.empty();
    if (fresh)
        copyLinks(bake.caches, halfs, occluded);
    Writer writer{bake, hidden, halfs, occluded};
    if (fresh)
        parallelRanges(hidden.directions.size(), kLinksAtOnce,
                       [&](std::size_t begin, std::size_t end) {
                           for (std::size_t k = begin; k < end; ++k)
                               if (hidden.directions[k] != 0)
                                   writer.write(k);
                       });
    else
        parallelRanges(hidden.changed.size(), kLinksAtOnce,
                       [&](std::size_t begin, std::size_t end) {
                           for (std::size_t i = begin; i < end; ++i)
                               writer.write(hidden.changed[i]);
                       });
}

} // namespace limn
