// SPDX-License-Identifier: MIT
#include "engine/relight/dimming.h"

#include "engine/bake/cluster_tree.h"
#include "engine/core/parallel.h"
#include "engine/math/packing.h"
#include "engine/math/sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace limn {

namespace {

constexpr float kPlanar = 0.99f; // length of the mean normal
// u of a cone that four samples are enough for: a hundred of them fill the hemisphere.
constexpr float kNarrow = 0.01f;

/// What a link's light comes through.
struct LinkCone {
    std::uint32_t node;
    glm::vec3 direction; ///< of this length: most cones meet nothing and need no unit
    float length;
    float u; ///< 1 - cos(half-angle)
};

/// As unpackOctUnnormalised, without a call of fmax.
glm::vec3 octVector(const Link& link) {
    const float x = float(std::int16_t(link.octX)), y = float(std::int16_t(link.octY));
    const float z = 32767 - std::abs(x) - std::abs(y), fold = z < 0 ? -z : 0;
    return {x - std::copysign(fold, x), y - std::copysign(fold, y), z};
}

LinkCone coneOf(const Caches& caches, std::uint32_t k, std::size_t coefficients) {
    if (caches.shNode.empty()) {
        const Link& link = caches.links[k];
        const glm::vec3 d = octVector(link);
        return {link.node, d, glm::length(d), halfToFloat(link.u)};
    }
    // The first two bands of a cone: transport Y_00 and transport (2 - u) / 2 Y_1m.
    const std::uint16_t* h = caches.shCoefficients.data() + std::size_t(k) * coefficients;
    const glm::vec3 first(halfToFloat(h[3]), halfToFloat(h[1]), halfToFloat(h[2]));
    const float length = glm::length(first), zeroth = halfToFloat(h[0]);
    if (!(length > 0) || !(zeroth > 0))
        return {caches.shNode[k], {0, 0, 1}, 1, 2};
    const float u = 2 * (1 - length / (std::numbers::sqrt3_v<float> * zeroth));
    return {caches.shNode[k], first, length, std::clamp(u, 0.f, 2.f)};
}

/// The lattice of DirectionSet, as strata of height and directions about the axis.
struct Spread {
    float stratum[ConeSamples::kMost], x[ConeSamples::kMost], y[ConeSamples::kMost];

    explicit Spread(std::uint32_t count) {
        const DirectionSet set(count, false, 0);
        for (std::uint32_t k = 0; k < count; ++k) {
            const glm::vec3 d = set[k];
            const float r = std::sqrt(d.x * d.x + d.y * d.y);
            stratum[k] = 1 - d.z, x[k] = d.x / r, y[k] = d.y / r;
        }
    }
};

/// How a cache sees a blocker's sphere.
struct Sight {
    const Blocker* blocker;
    glm::vec3 direction; ///< unit
    float cosine, sine;  ///< of the half-angle; -1, 0 from within
    float nearest;       ///< [m]
};

/// How far light comes from along unit `d`, where the cluster's centre lies `way` from the cache.
float distanceAlong(const SenderPlace& place, glm::vec3 way, float distance, glm::vec3 d) {
    if (place.normal == glm::vec3(0))
        return distance + place.radius;
    const float along = glm::dot(place.normal, d);
    const float t = std::abs(along) > 0.02f ? glm::dot(place.normal, way) / along : distance;
    return std::clamp(t, distance - place.radius, distance + place.radius);
}

struct Dimmer {
    const Bake& bake;
    const std::vector<SenderPlace>& places;
    const std::vector<Blocker>& blockers;
    glm::vec3 cell; ///< of the grid [m]

    std::vector<Sight> sights(std::uint32_t cache) const {
        std::vector<Sight> result;
        const glm::vec3 x = bake.caches.position[cache], n = bake.caches.normal[cache];
        const bool hemisphere = bake.caches.kind[cache] == CacheKind::Hemisphere,
                   grid = bake.caches.kind[cache] == CacheKind::Grid;
        for (const Blocker& b : blockers) {
            const glm::vec3 way = b.centre - x;
            const float distance = glm::length(way);
            if (hemisphere && glm::dot(n, way) < -b.radius)
                continue;
            if (grid && glm::all(glm::greaterThan(x, b.bounds.lower - cell)) &&
                glm::all(glm::lessThan(x, b.bounds.upper + cell)))
                continue;
            if (distance <= b.radius) {
                result.push_back({&b, {0, 0, 1}, -1, 0, 0});
                continue;
            }
            const float sine = b.radius / distance, cosine = std::sqrt(1 - sine * sine);
            if (sine * sine / (1 + cosine) >= kLeastBlocked) // 1 - cosine, without cancellation
                result.push_back({&b, way / distance, cosine, sine, distance - b.radius});
        }
        return result;
    }

    /// The share of a link's cone that is free, in [0, 1].
    float freeShare(glm::vec3 from, const LinkCone& cone, const std::vector<Sight>& sights) const {
        const float c = 1 - cone.u, s = std::sqrt(cone.u * (2 - cone.u));
        ConeSamples samples; // made when needed
        for (const Sight& sight : sights) {
            const bool wide = c <= -sight.cosine; // together they go all the way round
            const float least = c * sight.cosine - s * sight.sine;
            if (!wide && glm::dot(cone.direction, sight.direction) < least * cone.length)
                continue;
            if (samples.count == 0)
                fill(cone, places[cone.node], from, samples);
            if (sight.nearest < samples.farthest)
                block(*sight.blocker, from, samples);
        }
        if (samples.count == 0)
            return 1;
        const auto blocked = std::count(samples.blocked, samples.blocked + samples.count, true);
        return 1 - float(blocked) / float(samples.count);
    }

    static void fill(const LinkCone& cone, const SenderPlace& place, glm::vec3 from,
                     ConeSamples& out) {
        const glm::vec3 way = place.centre - from;
        const float distance = glm::length(way);
        out.farthest = distance + place.radius;
        static const Spread few(4), many(ConeSamples::kMost);
        const bool narrow = cone.u < kNarrow;
        const Spread& spread = narrow ? few : many;
        out.count = narrow ? 4 : ConeSamples::kMost;
        const glm::mat3 toWorld = basisAround(cone.direction / cone.length);
        for (std::size_t k = 0; k < out.count; ++k) {
            const float z = 1 - cone.u * spread.stratum[k]; // equal solid angles
            const float r = std::sqrt(std::max(1 - z * z, 0.f));
            const glm::vec3 d = toWorld * glm::vec3(spread.x[k] * r, spread.y[k] * r, z);
            out.x[k] = d.x, out.y[k] = d.y, out.z[k] = d.z;
            out.tMost[k] = distanceAlong(place, way, distance, d) * 0.999f;
            out.blocked[k] = false;
        }
    }

    /// Per link of the cache; empty where all are 1.
    std::vector<float> freeShares(std::uint32_t cache) const {
        const Caches& c = bake.caches;
        const std::vector<Sight> seen = sights(cache);
        std::vector<float> shares;
        if (seen.empty())
            return shares;
        shares.reserve(c.linkBegin[cache + 1] - c.linkBegin[cache]);
        const auto coefficients = std::size_t(bake.settings.bands) * bake.settings.bands;
        bool any = false;
        for (std::uint32_t k = c.linkBegin[cache]; k < c.linkBegin[cache + 1]; ++k) {
            shares.push_back(freeShare(c.position[cache], coneOf(c, k, coefficients), seen));
            any = any || shares.back() < 1;
        }
        if (!any)
            shares.clear();
        return shares;
    }
};

/// Writes the links of the k-th dimmed cache to their place.
struct Writer {
    const Bake& bake;
    const std::vector<std::vector<float>>& shares; ///< per cache of the bake
    const std::vector<bool>& sky;
    DimmedLinks& out;

    /// Makes room for the caches that have shares; says where each one's links go.
    void place() {
        const Caches& from = bake.caches;
        Caches& to = out.links;
        for (std::uint32_t c = 0; c < shares.size(); ++c) {
            if (shares[c].empty())
                continue;
            const auto gone = std::uint32_t(std::count(shares[c].begin(), shares[c].end(), 0.f)),
                       whole = std::uint32_t(std::count(shares[c].begin(), shares[c].end(), 1.f)),
                       all = std::uint32_t(shares[c].size());
            to.linkBegin.push_back(to.linkBegin.back() + all - gone);
            to.linkExponent.push_back(from.linkExponent[c]);
            out.cache.push_back(c);
            out.lightmapCount += c < from.lightmapCount ? 1 : 0;
            out.dimmed += all - whole;
        }
        out.beforeSky.resize(out.cache.size());
        if (from.shNode.empty())
            to.links.resize(to.linkBegin.back());
        to.shNode.resize(from.shNode.empty() ? 0 : to.linkBegin.back());
        to.shCoefficients.resize(to.shNode.size() * coefficients());
    }

    std::size_t coefficients() const {
        return std::size_t(bake.settings.bands) * bake.settings.bands;
    }

    static std::uint16_t dim(std::uint16_t half, float share) {
        return share < 1 ? floatToHalf(halfToFloat(half) * share) : half;
    }

    void write(std::size_t k) {
        const Caches& from = bake.caches;
        Caches& to = out.links;
        const std::uint32_t begin = from.linkBegin[out.cache[k]];
        const std::vector<float>& share = shares[out.cache[k]];
        std::uint32_t at = to.linkBegin[k], beforeSky = at;
        for (std::uint32_t i = 0; i < share.size(); ++i) {
            if (!(share[i] > 0))
                continue;
            const bool cones = from.shNode.empty();
            const std::uint32_t node = cones ? from.links[begin + i].node : from.shNode[begin + i];
            if (cones) {
                to.links[at] = from.links[begin + i];
                to.links[at].transport = dim(to.links[at].transport, share[i]);
            } else {
                to.shNode[at] = node;
                for (std::size_t n = 0; n < coefficients(); ++n)
                    to.shCoefficients[at * coefficients() + n] =
                        dim(from.shCoefficients[(begin + i) * coefficients() + n], share[i]);
            }
            ++at;
            if (!sky[node])
                beforeSky = at; // those to sky come last
        }
        out.beforeSky[k] = beforeSky;
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

DimmedLinks dimLinks(const Bake& bake, const std::vector<SenderPlace>& places,
                     const std::vector<Blocker>& blockers) {
    DimmedLinks out;
    out.links.linkBegin = {0};
    if (blockers.empty())
        return out;
    const glm::vec3 cell =
        bake.gridBounds.size() / glm::vec3(glm::max(bake.gridSize, glm::uvec3(1)));
    const Dimmer dimmer{bake, places, blockers, cell};
    std::vector<std::vector<float>> shares(bake.caches.size());
    parallelRanges(shares.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            shares[c] = dimmer.freeShares(std::uint32_t(c));
    });
    const std::vector<bool> sky = skyNodes(bake.tree);
    Writer writer{bake, shares, sky, out};
    writer.place();
    parallelRanges(out.cache.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            writer.write(k);
    });
    return out;
}

} // namespace limn
