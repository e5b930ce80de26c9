// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/rays/sky_hits.h"

#include "engine/core/large_pages.h"
#include "engine/core/parallel.h"
#include "engine/math/packing.h"
#include "engine/techniques/illuminance/bake/rays/seen_hits.h"
#include "engine/techniques/illuminance/bake/senders/cluster_tree.h"
#include "engine/trace/rays_together.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr std::uint32_t kRaysPerSkyHit = 8; ///< a cache aims where its neighbours need more
constexpr std::uint32_t kNoCache = ~0U;

bool isSky(std::uint32_t sender, std::size_t surfels) {
    return sender >= surfels && sender < GatherHits::kFirstMark;
}

/// Finds the caches of the texels around a texel, and of the cells around a cell of the grid. Some
/// may lie in other charts or, at the end of a row, in the next one.
class Neighbours {
public:
    explicit Neighbours(const SkyInput& in)
        : m_caches(in.caches), m_ofTexel(std::size_t(in.lightmap.x) * in.lightmap.y, kNoCache) {
        for (std::uint32_t c = 0; c < in.caches.lightmapCount; ++c)
            m_ofTexel[in.caches.texel[c]] = c;
        const auto row = std::ptrdiff_t(in.lightmap.x), gridRow = std::ptrdiff_t(in.grid.x),
                   gridLayer = gridRow * std::ptrdiff_t(in.grid.y);
        m_texelSteps = {-row - 1, -row, -row + 1, -1, 1, row - 1, row, row + 1};
        m_cellSteps = {-gridLayer, -gridRow, -1, 1, gridRow, gridLayer};
    }

    /// Calls visit(cache) for each neighbour.
    template <class Visit>
    void each(std::uint32_t cache, const Visit& visit) const {
        const bool texel = m_caches.kind[cache] == CacheKind::Hemisphere;
        const auto count =
            std::ptrdiff_t(texel ? m_ofTexel.size() : m_caches.size() - m_caches.lightmapCount);
        for (const std::ptrdiff_t step :
             texel ? std::span<const std::ptrdiff_t>(m_texelSteps) : m_cellSteps) {
            const std::ptrdiff_t place = std::ptrdiff_t(m_caches.texel[cache]) + step;
            if (place < 0 || place >= count)
                continue;
            const std::uint32_t other = texel ? m_ofTexel[std::size_t(place)]
                                              : m_caches.lightmapCount + std::uint32_t(place);
            if (other != kNoCache)
                visit(other);
        }
    }

private:
    const Caches& m_caches;
    std::vector<std::uint32_t> m_ofTexel; ///< per texel: its cache, or kNoCache
    std::array<std::ptrdiff_t, 8> m_texelSteps{};
    std::array<std::ptrdiff_t, 6> m_cellSteps{};
};

/// Looks for the sky from one cache after another.
class SkyFinder {
public:
    SkyFinder(const SkyInput& input, const Neighbours& neighbours,
              const std::vector<std::uint32_t>& skyRays)
        : in(input), m_neighbours(neighbours), m_skyRays(skyRays) {}

    void find(std::uint32_t cache, std::vector<SkyHit>& found);
    std::uint64_t traced() const { return m_traced; } ///< number of rays

private:
    const SkyInput& in;
    const Neighbours& m_neighbours;
    const std::vector<std::uint32_t>& m_skyRays; ///< per cache: rays that see the sky
    std::vector<glm::vec3> m_guides; ///< unit; directions in which the neighbours see the sky
    std::vector<std::uint32_t> m_validPoints; ///< points of the cache that are not in a wall
    std::uint64_t m_traced = 0;

    void findGuides(std::uint32_t cache);
    glm::vec3 aimed(std::uint32_t cache, std::uint32_t k, float solidAngle) const;
};

void SkyFinder::findGuides(std::uint32_t cache) {
    m_guides.clear();
    std::uint64_t rayCount = 0, skyRayCount = 0;
    m_neighbours.each(cache, [&](std::uint32_t other) {
        rayCount += in.hits.rays;
        skyRayCount += m_skyRays[other];
    });
    if (skyRayCount * kRaysPerSkyHit >= rayCount)
        return;
    m_neighbours.each(cache, [&](std::uint32_t other) {
        if (m_skyRays[other] == 0)
            return;
        const std::span<const std::uint32_t> senders = in.hits.sendersOf(other);
        const CacheRays rays = raysOf(in.caches, in.points, other, in.hits.rays);
        for (std::uint32_t r = 0; r < in.hits.rays; ++r)
            if (isSky(senders[r], in.surfels))
                m_guides.push_back(rays[r]);
    });
}

/// Number of rays of each cache that see the sky.
std::vector<std::uint32_t> countSkyRays(const SkyInput& in) {
    std::vector<std::uint32_t> result(in.caches.size());
    parallelRanges(result.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            result[c] = std::uint32_t(
                std::ranges::count_if(in.hits.sendersOf(std::uint32_t(c)),
                                      [&](std::uint32_t s) { return isSky(s, in.surfels); }));
    });
    return result;
}

/// Direction of ray k of those aimed: within a cone of `solidAngle` around a guide. The guides take
/// turns.
glm::vec3 SkyFinder::aimed(std::uint32_t cache, std::uint32_t k, float solidAngle) const {
    const std::uint32_t seed = mixBits(in.points.seed[cache] + 2) + 3 * k;
    const float u = unitFloat(mixBits(seed)), v = unitFloat(mixBits(seed + 1)),
                w = unitFloat(mixBits(seed + 2));
    const auto guide = std::size_t((float(k) + u) * float(m_guides.size()) / float(kSkyRays));
    const float z = 1 - v * solidAngle / (2 * kPi), r = std::sqrt(std::max(0.f, 1 - z * z)),
                angle = 2 * kPi * w;
    return glm::normalize(basisAround(m_guides[std::min(guide, m_guides.size() - 1)]) *
                          glm::vec3(r * std::cos(angle), r * std::sin(angle), z));
}

void SkyFinder::find(std::uint32_t cache, std::vector<SkyHit>& found) {
    found.clear();
    findGuides(cache);
    const std::span<const std::uint32_t> senders = in.hits.sendersOf(cache);
    m_validPoints.clear();
    forEachValidPoint(in.points, cache, senders,
                      [&](std::uint32_t point) { m_validPoints.push_back(point); });
    if (m_guides.empty() || m_validPoints.empty())
        return;
    const CacheRays rays = raysOf(in.caches, in.points, cache, in.hits.rays);
    const bool hemisphere = in.caches.kind[cache] == CacheKind::Hemisphere;
    const float solidAngle = rays.local.wholeAngle() / float(in.hits.rays),
                minCosine = 1 - solidAngle / (2 * kPi);
    // Rays per solid angle are the cache's own that count, and those around each guide.
    const float kept = float(validRays(senders)) / float(in.hits.rays),
                guided = float(kSkyRays) / (float(m_guides.size()) * solidAngle);
    const auto add = [&](std::uint32_t sender, std::uint32_t point, glm::vec3 d, float z) {
        const auto near = std::ranges::count_if(
            m_guides, [&](glm::vec3 guide) { return glm::dot(guide, d) >= minCosine; });
        const float density = kept * rays.local.density(z) + guided * float(near);
        found.push_back({sender, point, packOct(d), 1 / (kPi * density)});
    };
    for (std::uint32_t r = 0; r < in.hits.rays; ++r)
        if (isSky(senders[r], in.surfels))
            add(senders[r], in.points.begin[cache] + r % rays.points, rays[r],
                rays.local.height(r));
    struct Aimed {
        std::uint32_t point;
        glm::vec3 direction;
    };
    RaysTogether<Aimed> aims(in.trace, TraceMask::Static);
    const auto open = [&](const Aimed& a) {
        const float z = hemisphere ? glm::dot(in.points.normal[a.point], a.direction) : 0;
        add(std::uint32_t(in.surfels) + skyCellOf(a.direction), a.point, a.direction, z);
    };
    for (std::uint32_t k = 0; k < kSkyRays; ++k) {
        const std::uint32_t point = m_validPoints[k % m_validPoints.size()];
        const glm::vec3 normal = in.points.normal[point], d = aimed(cache, k, solidAngle);
        if (!hemisphere || glm::dot(d, normal) > 0)
            aims.add({in.trace.clearOf(in.points.position[point], normal), d}, {point, d}, open);
    }
    aims.flush(open);
    m_traced += aims.traced();
}

} // namespace

SkyHits findSkyHits(const SkyInput& in, const Progress& progress) {
    const Neighbours neighbours(in);
    const std::vector<std::uint32_t> skyRays = countSkyRays(in);
    std::vector<std::vector<SkyHit>> hits(in.caches.size());
    std::atomic<std::uint64_t> rays = 0;
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    parallelRanges(hits.size(), 16, quiet, "trace", [&](std::size_t begin, std::size_t end) {
        SkyFinder finder(in, neighbours, skyRays);
        std::vector<SkyHit> found;
        for (std::size_t c = begin; c < end; ++c) {
            finder.find(std::uint32_t(c), found);
            hits[c] = found; // a copy has no spare capacity
        }
        rays += finder.traced();
    });
    SkyHits result;
    result.begin.push_back(0);
    for (const std::vector<SkyHit>& s : hits)
        result.begin.push_back(result.begin.back() + std::uint32_t(s.size()));
    reserveLarge(result.all, result.begin.back());
    for (const std::vector<SkyHit>& s : hits)
        result.all.insert(result.all.end(), s.begin(), s.end());
    result.rays = rays;
    return result;
}

void takeSkyHits(SkyHits sky, std::size_t surfels, GatherHits& hits) {
    hits.sky = std::move(sky);
    for (std::size_t c = 0; c + 1 < hits.sky.begin.size(); ++c) {
        if (hits.sky.begin[c] == hits.sky.begin[c + 1])
            continue;
        const auto first = hits.sender.begin() + std::ptrdiff_t(c * hits.rays);
        std::replace_if(
            first, first + hits.rays, [&](std::uint32_t s) { return isSky(s, surfels); },
            GatherHits::kAimed);
    }
}

FormFactor formFactorOf(const SkyHit& sky, const CachePoints& points, CacheKind kind) {
    const glm::vec3 d = unpackOct(sky.direction.x, sky.direction.y);
    const float cosTheta = std::max(glm::dot(d, points.normal[sky.point]), 0.f);
    return {sky.transport, sky.transport * irradianceShare(kind, cosTheta), sky.transport * d};
}

} // namespace limn
