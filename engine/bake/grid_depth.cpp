// SPDX-License-Identifier: MIT
#include "engine/bake/grid_depth.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr int kSide = int(kGridDepthSide);

/// The four texels about a direction, with bilinear weights.
struct OctLookup {
    std::array<std::uint32_t, 4> texel;
    std::array<float, 4> weight;
};

/// A texel beyond the map's border is one within it: the square's sides are folded at their middle.
std::uint32_t texelAt(int x, int y) {
    if (x < 0 || x >= kSide) {
        x = x < 0 ? -1 - x : 2 * kSide - 1 - x;
        y = kSide - 1 - y;
    }
    if (y < 0 || y >= kSide) {
        y = y < 0 ? -1 - y : 2 * kSide - 1 - y;
        x = kSide - 1 - x;
    }
    return std::uint32_t(y * kSide + x);
}

float norm1(glm::vec3 v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// `d` need not be unit, but not 0.
OctLookup octLookup(glm::vec3 d) {
    glm::vec2 p = glm::vec2(d) / norm1(d);
    if (d.z < 0)
        p = {std::copysign(1 - std::abs(p.y), d.x), std::copysign(1 - std::abs(p.x), d.y)};
    const glm::vec2 at = (p * 0.5f + 0.5f) * float(kSide) - 0.5f;
    const glm::vec2 base = glm::floor(at), f = at - base;
    const int x = int(base.x), y = int(base.y);
    return {{texelAt(x, y), texelAt(x + 1, y), texelAt(x, y + 1), texelAt(x + 1, y + 1)},
            {(1 - f.x) * (1 - f.y), f.x * (1 - f.y), (1 - f.x) * f.y, f.x * f.y}};
}

/// Where a texel's middle lies on the octahedron, |p|_1 = 1.
glm::vec3 texelPoint(std::uint32_t texel) {
    const glm::vec2 p = (glm::vec2(texel % kSide, texel / kSide) + 0.5f) * (2.f / kSide) - 1.f;
    const float z = 1 - std::abs(p.x) - std::abs(p.y), fold = std::max(-z, 0.f);
    return {p.x - std::copysign(fold, p.x), p.y - std::copysign(fold, p.y), z};
}

struct DepthMaker {
    const Surfels& surfels;
    const Caches& caches;
    const CachePoints& points;
    const std::vector<RawHit>& hits;
    std::uint32_t rays;
    float reach;

    /// How far a ray went that met surfel s.
    float length(std::uint32_t s, glm::vec3 from, glm::vec3 d) const {
        const glm::vec3 way = surfels.position[s] - from;
        const float to = glm::length(way), along = glm::dot(surfels.normal[s], d);
        if (!(std::abs(along) > 0.02f))
            return to;
        // A surfel stands for little more than its own disc; a curved surface leaves its plane.
        const float apart = 3 * std::sqrt(surfels.area[s] / std::numbers::pi_v<float>);
        return std::clamp(glm::dot(surfels.normal[s], way) / along, std::max(to - apart, 0.f),
                          to + apart);
    }

    /// 1 / depth at `p` of the octahedron, near where a ray along unit `d` met `hit`.
    float inverseDepth(glm::vec3 from, glm::vec3 d, RawHit hit, glm::vec3 p) const {
        const std::uint32_t s = hit & ~kBack;
        if (s >= surfels.size())
            return 0; // the sky
        const float met = 1 / std::max(length(s, from, d) * norm1(d), 1e-20f);
        const float distance = glm::dot(surfels.normal[s], surfels.position[s] - from);
        const float there = glm::dot(surfels.normal[s], p) / distance;
        return there > met / 2 && there < met * 2 ? there : met;
    }

    void cell(std::uint32_t cache, std::uint16_t* out) const {
        const RawHit* own = hits.data() + std::size_t(cache) * rays;
        std::uint32_t backs = 0;
        for (std::uint32_t r = 0; r < rays; ++r)
            backs += (own[r] & kBack) ? 1 : 0; // kUntraced has the bit too
        if (2 * backs > rays) {                // in a solid: as for its light
            std::fill_n(out, kGridDepthTexels, std::uint16_t(0xffff));
            return;
        }
        const CacheRays directions = raysOf(caches, points, cache, rays);
        std::vector<glm::vec3> way(rays);
        std::array<std::uint32_t, kGridDepthTexels> nearest;
        nearest.fill(~0U);
        const auto offer = [&](std::uint32_t texel, std::uint32_t r) {
            const glm::vec3 p = texelPoint(texel);
            std::uint32_t& best = nearest[texel];
            if (best == ~0U || glm::dot(way[r], p) > glm::dot(way[best], p))
                best = r;
        };
        for (std::uint32_t r = 0; r < rays; ++r) {
            way[r] = directions[r];
            for (const std::uint32_t texel : octLookup(way[r]).texel)
                offer(texel, r);
        }
        const glm::vec3 from = caches.position[cache];
        for (std::uint32_t i = 0; i < kGridDepthTexels; ++i) {
            if (nearest[i] == ~0U) // few rays
                for (std::uint32_t r = 0; r < rays; ++r)
                    offer(i, r);
            const float inverse =
                inverseDepth(from, way[nearest[i]], own[nearest[i]], texelPoint(i));
            out[i] = std::uint16_t(
                std::lround(std::clamp(inverse * reach / kGridDepthScale, 0.f, 1.f) * 65535));
        }
    }
};

} // namespace

float gridReach(const Bounds& bounds, glm::uvec3 size) {
    return norm1(bounds.size() / glm::vec3(glm::max(size, glm::uvec3(1))));
}

std::vector<std::uint16_t> gridDepths(const Surfels& surfels, const Caches& caches,
                                      const CachePoints& points, const std::vector<RawHit>& hits,
                                      std::uint32_t rays, float reach) {
    const std::size_t cells = caches.size() - caches.lightmapCount;
    std::vector<std::uint16_t> depths(cells * kGridDepthTexels, 0);
    const DepthMaker maker{surfels, caches, points, hits, rays, reach};
    parallelRanges(cells, 8, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            maker.cell(caches.lightmapCount + std::uint32_t(c), &depths[c * kGridDepthTexels]);
    });
    return depths;
}

float seenFromCell(const std::uint16_t* texels, glm::vec3 way, float reach) {
    const float length = norm1(way);
    if (!(length > 0))
        return texels[0] == 0xffff ? 0.f : 1.f;
    float inverse = 0;
    const OctLookup at = octLookup(way);
    for (std::size_t k = 0; k < 4; ++k)
        inverse += at.weight[k] * float(texels[at.texel[k]]);
    const float share = length * inverse * (kGridDepthScale / 65535 / reach);
    return std::clamp((1.15f - share) * 10, 0.f, 1.f);
}

} // namespace limn
