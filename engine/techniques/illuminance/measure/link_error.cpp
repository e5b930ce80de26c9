// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/measure/link_error.h"

#include "engine/core/parallel.h"
#include "engine/techniques/illuminance/bake/rays/gather.h"
#include "engine/techniques/illuminance/bake/rays/seen_hits.h"
#include "engine/techniques/illuminance/format/link_storage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limn {

namespace {

constexpr std::uint32_t kNone = ~0U;

/// Sums over links, caches or normals.
struct Deviation {
    double error = 0, size = 0; ///< squares

    void add(double is, double should) {
        error += (is - should) * (is - should);
        size += should * should;
    }
    double relative() const { return size > 0 ? std::sqrt(error / size) : 0; }
};

/// The sums of one cache, in doubles, so that their order matters little.
struct CacheDeviations {
    std::array<Deviation, kMaxBands> link, lit;
    std::array<Deviation, LinkError::kTilts.size()> irradiance;
    std::array<double, LinkError::kTilts.size()> mean{}; ///< true irradiance, summed
    std::uint64_t rays = 0, unlinked = 0;
};

/// Marks all rays of points most of whose rays meet backs, and the other rays that meet backs.
void markBacks(std::uint32_t points, std::span<std::uint32_t> sender) {
    for (std::uint32_t k = 0; k < points; ++k) {
        std::uint32_t all = 0, backs = 0;
        for (std::size_t r = k; r < sender.size(); r += points) {
            ++all;
            backs += (sender[r] & kBack) != 0 ? 1 : 0;
        }
        for (std::size_t r = k; r < sender.size(); r += points)
            if (2 * backs > all)
                sender[r] = GatherHits::kExcluded;
            else if ((sender[r] & kBack) != 0)
                sender[r] = GatherHits::kBackFace;
    }
}

/// Appends a cache of the bake and its points.
void addCache(const Caches& caches, std::uint32_t cache, const CachePoints& points,
              std::uint32_t index, SightReference& out) {
    out.cache.push_back(cache);
    out.caches.kind.push_back(caches.kind[cache]);
    out.caches.position.push_back(caches.position[cache]);
    out.caches.normal.push_back(caches.normal[cache]);
    for (std::uint32_t p = points.begin[index]; p < points.begin[index + 1]; ++p) {
        out.points.position.push_back(points.position[p]);
        out.points.normal.push_back(points.normal[p]);
    }
    out.points.begin.push_back(std::uint32_t(out.points.position.size()));
    out.points.seed.push_back(points.seed[index]);
}

/// A normal in the frame of a cache's points, in which z is the normal, and the index of its tilt.
struct TiltedNormal {
    std::size_t tilt;
    glm::vec3 normal;
};
std::vector<TiltedNormal> tiltedNormals(CacheKind kind) {
    std::vector<TiltedNormal> result;
    for (std::size_t t = 0; t < LinkError::kTilts.size(); ++t) {
        if (kind == CacheKind::Grid) {
            for (int axis = 0; axis < 3; ++axis)
                for (const float side : {-1.f, 1.f}) {
                    glm::vec3 n{0};
                    n[axis] = side;
                    result.push_back({t, n});
                }
            continue;
        }
        const float tilt = LinkError::kTilts[t] / 180 * std::numbers::pi_v<float>,
                    c = std::cos(tilt), s = std::sin(tilt);
        for (const glm::vec3 n : {glm::vec3(s, 0, c), {0, s, c}, {-s, 0, c}, {0, -s, c}})
            result.push_back({t, n});
    }
    return result;
}

class CacheMeter {
public:
    CacheMeter(const Bake& bake, const SightReference& reference,
               const std::vector<glm::vec4>& radiosity)
        : m_bake(bake), m_reference(reference), m_radiosity(radiosity),
          m_bands(int(bake.settings.bands)), m_count(std::size_t(m_bands * m_bands)),
          m_linkOf(bake.tree.size(), kNone) {}

    CacheDeviations measure(std::uint32_t i) {
        const Caches& caches = m_bake.caches;
        m_first = caches.linkBegin[m_reference.cache[i]];
        m_last = caches.linkBegin[m_reference.cache[i] + 1];
        const std::size_t links = m_last - m_first;
        m_is.assign(links * m_count, 0);
        m_true.assign(links * m_count, 0);
        m_lit.fill(0);
        m_normals = tiltedNormals(caches.kind[m_reference.cache[i]]);
        m_irradiance.assign(m_normals.size(), 0);
        for (std::uint32_t k = m_first; k < m_last; ++k) {
            expandLink(caches, m_reference.cache[i], k, m_bands,
                       m_is.data() + (k - m_first) * m_count);
            m_linkOf[linkWeight(caches, m_reference.cache[i], k).node] = k - m_first;
        }
        CacheDeviations result;
        sumRays(i, result);
        compare(i, result);
        for (std::uint32_t k = m_first; k < m_last; ++k)
            m_linkOf[linkWeight(caches, m_reference.cache[i], k).node] = kNone;
        return result;
    }

private:
    std::uint32_t nodeOf(std::uint32_t link) const {
        const Caches& caches = m_bake.caches;
        return caches.shNode.empty() ? caches.links[m_first + link].node
                                     : caches.shNode[m_first + link];
    }

    std::uint32_t linkAbove(std::uint32_t node) const {
        while (node != kNone && m_linkOf[node] == kNone)
            node = m_bake.tree.parent[node];
        return node == kNone ? kNone : m_linkOf[node];
    }

    void sumRays(std::uint32_t i, CacheDeviations& result) {
        const std::uint32_t count = m_reference.rays;
        const std::uint32_t* sender = m_reference.sender.data() + std::size_t(i) * count;
        const std::uint32_t kept = validRays({sender, count});
        const CacheRays rays = raysOf(m_reference.caches, m_reference.points, i, count);
        const float all = float(count) / (std::numbers::pi_v<float> * float(std::max(kept, 1U)));
        float y[kMaxCoefficients];
        for (std::uint32_t r = 0; r < count; ++r) {
            if (sender[r] >= GatherHits::kFirstMark)
                continue;
            ++result.rays;
            const glm::vec3 local = rays.local[r];
            const float weight = rays.local.solidAngle(r) * all;
            shBasis(m_bands, rays.toWorld[r % rays.points] * local, y);
            const std::uint32_t link = linkAbove(sender[r]);
            if (link == kNone)
                ++result.unlinked;
            else
                for (std::size_t k = 0; k < m_count; ++k)
                    m_true[link * m_count + k] += double(weight * y[k]);
            const float sent = weight * m_radiosity[sender[r]].w;
            for (std::size_t k = 0; k < m_count; ++k)
                m_lit[k] += double(sent * y[k]);
            for (std::size_t n = 0; n < m_normals.size(); ++n)
                m_irradiance[n] +=
                    double(sent * std::max(glm::dot(m_normals[n].normal, local), 0.f));
        }
    }

    void compare(std::uint32_t i, CacheDeviations& result) const {
        float is[kMaxCoefficients] = {};
        for (std::uint32_t link = 0; link < m_last - m_first; ++link) {
            const float sent = m_radiosity[nodeOf(link)].w;
            for (std::size_t k = 0; k < m_count; ++k) {
                const float c = m_is[link * m_count + k];
                const double t = m_true[link * m_count + k];
                result.link[bandOf(k)].add(double(c), t);
                is[k] += c * sent;
            }
        }
        for (std::size_t k = 0; k < m_count; ++k)
            result.lit[bandOf(k)].add(double(is[k]), m_lit[k]);
        const CacheKind kind = m_reference.caches.kind[i];
        const glm::mat3 toWorld = basisAround(
            kind == CacheKind::Grid ? glm::vec3(0, 0, 1) : m_reference.caches.normal[i]);
        glm::vec3 sh[kMaxCoefficients];
        std::transform(is, is + m_count, sh, [](float c) { return glm::vec3(c); });
        for (std::size_t n = 0; n < m_normals.size(); ++n) {
            const glm::vec3 normal = toWorld * m_normals[n].normal;
            const std::size_t t = m_normals[n].tilt;
            result.irradiance[t].add(
                double(shIrradiance(std::min(m_bands, kIrradianceBands), sh, normal).x),
                m_irradiance[n]);
            result.mean[t] += m_irradiance[n];
        }
    }

    static std::size_t bandOf(std::size_t k) { return std::size_t(std::sqrt(double(k) + 0.5)); }

    const Bake& m_bake;
    const SightReference& m_reference;
    const std::vector<glm::vec4>& m_radiosity;
    int m_bands;
    std::size_t m_count; ///< coefficients
    std::uint32_t m_first = 0, m_last = 0;
    std::vector<std::uint32_t> m_linkOf; ///< per node, of this cache
    std::vector<float> m_is;
    std::vector<double> m_true;                 ///< of the rays that fall under links
    std::array<double, kMaxCoefficients> m_lit; ///< of all rays, lit
    std::vector<TiltedNormal> m_normals;
    std::vector<double> m_irradiance; ///< true, per normal
};

void operator+=(Deviation& a, const Deviation& b) {
    a.error += b.error;
    a.size += b.size;
}

} // namespace

SightReference traceSights(const TraceScene& trace, const SurfelSet& set, const OwnerTables& owners,
                           const Bake& bake, CacheKind kind, const CachePoints& points,
                           std::uint32_t first, std::uint32_t count, std::uint32_t multiple,
                           const Progress& progress) {
    const Caches& caches = bake.caches;
    SightReference result;
    result.rays = bake.settings.rays * multiple;
    result.points.begin = {0};
    const auto all = std::uint32_t(points.seed.size());
    const std::uint32_t stride = std::max(1U, (all + count - 1) / std::max(count, 1U));
    for (std::uint32_t index = 0; index < all; index += stride)
        if (caches.kind[first + index] == kind &&
            caches.linkBegin[first + index] < caches.linkBegin[first + index + 1])
            addCache(caches, first + index, points, index, result);
    result.sender.resize(result.cache.size() * std::size_t(result.rays));
    const RayGatherer gatherer(trace, set, result.caches, result.points, result.rays, owners);
    const bool done = parallelRanges(
        result.cache.size(), 1, progress, "reference", [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const auto cache = std::uint32_t(i);
                const std::span<std::uint32_t> sender(
                    result.sender.data() + i * std::size_t(result.rays), result.rays);
                const CacheRays rays = gatherer.directions(cache);
                for (std::uint32_t r = 0; r < result.rays; ++r)
                    sender[r] = gatherer.trace(gatherer.ray(rays, cache, r));
                markBacks(rays.points, sender);
            }
        });
    return done ? result : SightReference{};
}

LinkError measureLinks(const Bake& bake, const SightReference& reference,
                       const std::vector<glm::vec4>& radiosity) {
    std::vector<CacheDeviations> each(reference.cache.size());
    parallelRanges(each.size(), 16, [&](std::size_t begin, std::size_t end) {
        CacheMeter meter(bake, reference, radiosity);
        for (std::size_t i = begin; i < end; ++i)
            each[i] = meter.measure(std::uint32_t(i));
    });
    CacheDeviations sum;
    LinkError result;
    for (std::size_t i = 0; i < each.size(); ++i) {
        for (std::size_t l = 0; l < kMaxBands; ++l) {
            sum.link[l] += each[i].link[l];
            sum.lit[l] += each[i].lit[l];
        }
        for (std::size_t t = 0; t < LinkError::kTilts.size(); ++t) {
            sum.irradiance[t] += each[i].irradiance[t];
            sum.mean[t] += each[i].mean[t];
        }
        sum.rays += each[i].rays;
        sum.unlinked += each[i].unlinked;
        const std::uint32_t cache = reference.cache[i];
        result.links += bake.caches.linkBegin[cache + 1] - bake.caches.linkBegin[cache];
    }
    for (std::size_t l = 0; l < kMaxBands; ++l) {
        result.link[l] = sum.link[l].relative();
        result.lit[l] = sum.lit[l].relative();
    }
    if (each.empty())
        return result;
    const auto normals = double(each.size() * tiltedNormals(reference.caches.kind[0]).size() /
                                LinkError::kTilts.size());
    for (std::size_t t = 0; t < LinkError::kTilts.size(); ++t)
        if (sum.mean[t] > 0)
            result.irradiance[t] =
                std::sqrt(sum.irradiance[t].error / normals) / (sum.mean[t] / normals);
    result.unlinked = sum.rays > 0 ? double(sum.unlinked) / double(sum.rays) : 0;
    return result;
}

} // namespace limn
