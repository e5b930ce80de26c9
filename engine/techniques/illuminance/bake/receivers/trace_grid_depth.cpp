// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/receivers/trace_grid_depth.h"

#include "engine/core/parallel.h"
#include "engine/math/octahedral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

struct DepthMaker {
    const Surfels& surfels;
    const Caches& caches;
    const CachePoints& points;
    const std::vector<RawHit>& hits;
    std::uint32_t rays;
    float reach;

    /// Length of a ray that met surfel s.
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

    /// 1 / depth at `p` of the octahedron, close to where a ray along unit `d` met `hit`.
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
        const RawHit* cacheHits = hits.data() + std::size_t(cache) * rays;
        std::uint32_t backs = 0;
        for (std::uint32_t r = 0; r < rays; ++r)
            backs += (cacheHits[r] & kBack) ? 1 : 0; // kUntraced has the bit too
        if (2 * backs > rays) { // in a solid, by the same rule as for its light
            std::fill_n(out, kGridDepthTexels, std::uint16_t(0xffff));
            return;
        }
        const CacheRays directions = raysOf(caches, points, cache, rays);
        std::vector<glm::vec3> way(rays);
        std::array<std::uint32_t, kGridDepthTexels> nearest;
        nearest.fill(~0U);
        const auto offer = [&](std::uint32_t texel, std::uint32_t r) {
            const glm::vec3 p = gridDepthPoint(texel);
            std::uint32_t& best = nearest[texel];
            if (best == ~0U || glm::dot(way[r], p) > glm::dot(way[best], p))
                best = r;
        };
        for (std::uint32_t r = 0; r < rays; ++r) {
            way[r] = directions[r];
            for (const std::uint32_t texel : gridDepthLookup(way[r]).texel)
                offer(texel, r);
        }
        const glm::vec3 from = caches.position[cache];
        for (std::uint32_t i = 0; i < kGridDepthTexels; ++i) {
            if (nearest[i] == ~0U) // few rays
                for (std::uint32_t r = 0; r < rays; ++r)
                    offer(i, r);
            const float inverse =
                inverseDepth(from, way[nearest[i]], cacheHits[nearest[i]], gridDepthPoint(i));
            out[i] = std::uint16_t(
                std::lround(std::clamp(inverse * reach / kGridDepthScale, 0.f, 1.f) * 65535));
        }
    }
};

} // namespace

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

} // namespace limn
