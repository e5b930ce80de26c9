// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/links/build_links.h"

#include "engine/core/parallel.h"
#include "engine/math/sh.h"
#include "engine/techniques/illuminance/bake/cut/refinement_priority.h"
#include "engine/techniques/illuminance/bake/cut/visible_tree.h"
#include "engine/techniques/illuminance/bake/links/link_harmonics.h"
#include "engine/techniques/illuminance/bake/rays/seen_hits.h"
#include "engine/techniques/illuminance/bake/rays/sky_hits.h"
#include "engine/techniques/illuminance/bake/senders/cluster_tree.h"
#include "engine/techniques/illuminance/format/link_storage.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include <tbb/enumerable_thread_specific.h>

namespace limn {

namespace {

Cone makeCone(std::uint32_t node, const FormFactor& s) {
    const float length = glm::length(s.moment);
    // The mean cosine of a cone is 1 - u/2, so this cone has the sum's first two bands; but none is
    // narrower than the solid angle seen: pi solidAngle = 2 pi u.
    const float u =
        std::clamp(2 * (1 - length / s.solidAngle), std::min(s.solidAngle / 2, 2.f), 2.f);
    return {node, length > 0 ? s.moment / length : glm::vec3(0, 0, 1), u, s.solidAngle,
            s.irradiance};
}

/// Scales each link of a surface cache so that its sender contributes, through the SH, exactly the
/// cosine-weighted irradiance of its rays to the surface at the cache's points, as a mean. Three
/// bands of the clamped cosine are 6 % too strong for light along the normal, 8 % too weak at 60
/// degrees and leave 9 % at 90, and a round cone is too tall for a cluster seen along the surface.
/// Without this a wall lit from the side comes out up to a tenth too bright. The factor differs
/// from 1 by no more than those errors of the truncated series; radiance seen by other normals
/// changes as much.
void matchIrradiance(int bands, const IrradianceAxis& axis, std::vector<Cone>& cones) {
    float c[kMaxCoefficients];
    for (Cone& cone : cones) {
        std::fill_n(c, bands * bands, 0.f);
        addHarmonics(bands, cone.direction, cone.u, cone.transport, c);
        cone.transport *= axis.gainTo(cone.irradiance, c);
    }
}

glm::mat3 rotationAboutZ(float turns) {
    const float angle = 2 * std::numbers::pi_v<float> * turns;
    const float c = std::cos(angle), s = std::sin(angle);
    return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
}

/// What a ray of a cache stands for, if all of the cache's rays count.
struct LocalRay {
    glm::vec3 moment; ///< its direction times `weight`
    float weight;     ///< solid angle / pi
};

/// A cache's rays, without its own rotation about z and its surface's frame.
std::vector<LocalRay> unrotatedRays(std::uint32_t rays, CacheKind kind) {
    DirectionSet set = gatherDirections(rays, kind, 0);
    set.turn = 0;
    std::vector<LocalRay> result(rays);
    for (std::uint32_t r = 0; r < rays; ++r) {
        const float weight = set.solidAngle(r) / std::numbers::pi_v<float>;
        result[r] = {set[r] * weight, weight};
    }
    return result;
}

/// Input shared by the linking of all caches.
struct LinkInput {
    const Surfels& surfels;
    const GatherHits& hits;
    const CachePoints& points;
    const TrainingLight& training;
    const CutSettings& settings;
    SenderOrder order;
    std::vector<bool> sky;                    ///< skyNodes
    std::vector<LocalRay> hemisphere, sphere; ///< unrotated rays
};

/// One thread's working space for linking caches.
class CacheLinker {
public:
    explicit CacheLinker(const LinkInput& input) : in(input), m_seen(input.order) {}

    /// Builds the tree of what a cache sees. Returns false for a cache that sees nothing.
    bool findVisible(const Caches& caches, std::uint32_t cache) {
        forEachSample(caches, cache,
                      [&](std::uint32_t sender, const FormFactor& formFactor, float) {
                          m_seen.add(sender, formFactor);
                      });
        m_seen.build();
        return m_seen.size() > 0;
    }

    /// After findVisible(): number of visible leaves.
    std::uint32_t leaves() const { return m_seen.leaves(); }

    /// After findVisible(): priority and representative of each inner node.
    const CutChoices& weigh() {
        if (in.settings.criterion == CutCriterion::SolidAngle)
            m_priority.bySolidAngle(m_seen);
        else
            m_priority.byDetail(m_seen, in.training);
        return m_priority.choices();
    }

    /// After findVisible(): applies the refinements of a priority above `bound`, at most the best
    /// `maxLinks` - 1 of them.
    PackedLinks link(const Caches& caches, std::uint32_t cache, const CutChoices& choices,
                     float bound, std::uint32_t maxLinks) {
        chooseRefined(choices.priority, bound, maxLinks);
        findRead(choices.representative);
        m_cones.clear();
        addCone(m_seen.size() - 1);
        for (std::uint32_t i = m_seen.leaves(); i < m_seen.size(); ++i)
            if (m_refined[i])
                addCone(m_seen.child(i, 0)), addCone(m_seen.child(i, 1));
        std::sort(m_cones.begin(), m_cones.end(), [&](const Cone& a, const Cone& b) {
            return std::pair(in.sky[a.node], a.node) < std::pair(in.sky[b.node], b.node);
        });
        return in.settings.storage == LinkStorage::Sh ? projectSamples(caches, cache)
                                                      : packCacheCones(caches, cache);
    }

    /// After link(): calls visit(node, irradiance at a radiosity of 1) for each cluster whose mean
    /// a link reads, for weighByLinks(). A link to a representative reads no cluster's mean; it
    /// counts as one link to each of the senders that the cache saw.
    template <class Visit>
    void forEachRead(const Visit& visit) {
        m_place.assign(m_seen.size(), Place::AboveLinks);
        for (std::uint32_t i = m_seen.size(); i-- > 0;) { // children come before their parents
            Place& place = m_place[i];
            if (place == Place::AboveLinks && !m_refined[i])
                place = m_read[i] == m_seen.node[i] ? Place::ReadsCluster : Place::Represented;
            if (place == Place::ReadsCluster ||
                (place == Place::Represented && i < m_seen.leaves()))
                visit(m_seen.node[i], m_seen.formFactor[i].irradiance);
            if (i >= m_seen.leaves())
                for (const int side : {0, 1})
                    m_place[m_seen.child(i, side)] =
                        place == Place::ReadsCluster ? Place::BelowCluster : place;
        }
    }

private:
    enum class Place : std::uint8_t { AboveLinks, ReadsCluster, BelowCluster, Represented };

    /// The axis of the mean irradiance at the valid points of a surface cache, which face different
    /// ways where a texel covers a fold or a column.
    IrradianceAxis axisOf(const Caches& caches, std::uint32_t cache) {
        m_normals.clear();
        forEachValidPoint(in.points, cache, in.hits.sendersOf(cache), [&](std::uint32_t point) {
            m_normals.push_back(in.points.normal[point]);
        });
        return {std::min(in.settings.bands, kIrradianceBands), m_normals, caches.normal[cache]};
    }

    /// Calls visit(sender, FormFactor of the sample, u of the cone that it stands for) for rays,
    /// aimed samples and hits of the sky.
    template <class Visit>
    void forEachSample(const Caches& caches, std::uint32_t cache, const Visit& visit) const {
        forEachRay(caches, cache, visit);
        forEachAimedSample(in.surfels, in.hits, in.points, caches, cache, visit);
        forEachSkyHit(in.hits, in.points, caches, cache,
                      [&](std::uint32_t sender, const FormFactor& formFactor) {
                          visit(sender, formFactor, 0.f);
                      });
    }

    template <class Visit>
    void forEachRay(const Caches& caches, std::uint32_t cache, const Visit& visit) const {
        const std::uint32_t count = in.hits.rays;
        const std::span<const std::uint32_t> sender = in.hits.sendersOf(cache);
        const std::uint32_t kept = validRays(sender);
        if (kept == 0)
            return;
        const CacheRays rays = raysOf(caches, in.points, cache, count);
        const float all = float(count) / float(kept);
        const float half = all * irradianceShare(CacheKind::Grid, 0);
        const bool sphere = rays.local.sphere;
        const LocalRay* local = (sphere ? in.sphere : in.hemisphere).data();
        std::array<glm::mat3, AtlasTexel::kMaxPoints> toWorld{};
        for (std::uint32_t k = 0; k < rays.points; ++k)
            toWorld[k] = rays.toWorld[k] * rotationAboutZ(rays.local.turn) * all;
        for (std::uint32_t r = 0, k = 0; r < count; ++r) {
            if (sender[r] < GatherHits::kFirstMark)
                visit(sender[r],
                      FormFactor{all * local[r].weight,
                                 sphere ? half * local[r].weight : all * local[r].moment.z,
                                 toWorld[k] * local[r].moment},
                      0.f);
            k = k + 1 == rays.points ? 0 : k + 1;
        }
    }

    PackedLinks packCacheCones(const Caches& caches, std::uint32_t cache) {
        if (caches.kind[cache] == CacheKind::Hemisphere)
            matchIrradiance(std::min(in.settings.bands, kIrradianceBands), axisOf(caches, cache),
                            m_cones);
        return packCones(m_cones);
    }

    /// The harmonics of the samples under each of m_cones' nodes.
    PackedLinks projectSamples(const Caches& caches, std::uint32_t cache) {
        const int bands = in.settings.bands;
        const auto stride = std::size_t(bands * bands);
        findLinksOfLeaves();
        m_harmonics.assign(m_cones.size() * stride, 0);
        forEachSample(
            caches, cache, [&](std::uint32_t sender, const FormFactor& formFactor, float u) {
                addHarmonics(bands, formFactor.moment / formFactor.solidAngle, u,
                             formFactor.solidAngle, m_harmonics.data() + m_linkOf[sender] * stride);
            });
        if (caches.kind[cache] == CacheKind::Hemisphere) {
            const IrradianceAxis axis = axisOf(caches, cache);
            for (std::size_t k = 0; k < m_cones.size(); ++k) {
                float* coefficients = m_harmonics.data() + k * stride;
                const float gain = axis.gainTo(m_cones[k].irradiance, coefficients);
                std::transform(coefficients, coefficients + stride, coefficients,
                               [&](float c) { return c * gain; });
            }
        }
        std::vector<std::uint32_t> nodes;
        nodes.reserve(m_cones.size());
        for (const Cone& cone : m_cones)
            nodes.push_back(cone.node);
        return packHarmonics(bands, std::move(nodes), m_harmonics);
    }

    /// After addCone(): fills m_linkOf for the visible leaves.
    void findLinksOfLeaves() {
        constexpr std::uint32_t kNoLink = ~0U;
        m_linkOf.resize(in.sky.size());
        for (std::uint32_t k = 0; k < m_cones.size(); ++k)
            m_linkOf[m_cones[k].node] = k;
        m_linkAbove.assign(m_seen.size(), kNoLink);
        for (std::uint32_t i = m_seen.size(); i-- > 0;) { // children come before their parents
            if (m_linkAbove[i] == kNoLink && !m_refined[i])
                m_linkAbove[i] = m_linkOf[m_read[i]];
            if (i < m_seen.leaves())
                m_linkOf[m_seen.node[i]] = m_linkAbove[i];
            else
                for (const int side : {0, 1})
                    m_linkAbove[m_seen.child(i, side)] = m_linkAbove[i];
        }
    }

    void chooseRefined(const std::vector<float>& priority, float bound, std::uint32_t maxLinks) {
        m_order.clear();
        for (std::uint32_t i = 0; i < priority.size(); ++i)
            if (priority[i] > bound)
                m_order.emplace_back(-priority[i], ~i); // among equals the parent, which comes last
        const std::size_t count = std::min<std::size_t>(m_order.size(), maxLinks - 1);
        if (count < m_order.size())
            std::nth_element(m_order.begin(), m_order.begin() + std::ptrdiff_t(count),
                             m_order.end());
        m_refined.assign(m_seen.size(), false);
        for (std::size_t k = 0; k < count; ++k)
            m_refined[m_seen.leaves() + ~m_order[k].second] = true;
    }

    /// Fills m_read.
    void findRead(const std::vector<Representative>& representative) {
        m_read = m_seen.node;
        for (std::uint32_t i = m_seen.leaves(); i < m_seen.size(); ++i)
            if (const Representative choice = representative[i - m_seen.leaves()];
                choice != Representative::Cluster)
                m_read[i] = m_read[m_seen.child(i, choice == Representative::Right)];
    }

    void addCone(std::uint32_t i) {
        if (!m_refined[i])
            m_cones.push_back(makeCone(m_read[i], m_seen.formFactor[i]));
    }

    const LinkInput& in;
    VisibleTree m_seen;
    RefinementPriority m_priority;
    std::vector<std::pair<float, std::uint32_t>> m_order;
    std::vector<bool> m_refined;
    std::vector<std::uint32_t> m_read; ///< per node of m_seen, the ClusterTree's node to link
    std::vector<Cone> m_cones;
    std::vector<Place> m_place;       ///< per node of m_seen, for forEachRead()
    std::vector<glm::vec3> m_normals; ///< of one cache's points
    // For LinkStorage::Sh only:
    std::vector<float> m_harmonics;         ///< bands^2 for each of m_cones
    std::vector<std::uint32_t> m_linkOf;    ///< per node of the ClusterTree
    std::vector<std::uint32_t> m_linkAbove; ///< per node of m_seen
};

/// What links read, per node, summed over all caches. The sums are fixed-point numbers, so they do
/// not depend on the order of the caches.
class ReadSums {
public:
    ReadSums(std::uint32_t nodes, const CachePoints& points, std::uint32_t caches)
        : m_nodes(nodes), m_sums(std::vector<std::int64_t>(nodes, 0)) {
        double all = 1;
        for (std::uint32_t c = 0; c < caches; ++c)
            all += double(points.weightOf(c));
        constexpr double kMaxIrradiance = 16; // of one cache at a radiosity of 1; about 2 occurs
        m_scale = 0x1p62 / (kMaxIrradiance * all);
    }

    void add(CacheLinker& linker, float weight) {
        std::vector<std::int64_t>& sums = m_sums.local();
        linker.forEachRead([&](std::uint32_t node, float irradiance) {
            sums[node] += std::llround(double(weight) * double(irradiance) * m_scale);
        });
    }

    std::vector<double> sum() const {
        std::vector<std::int64_t> sum(m_nodes, 0);
        for (const std::vector<std::int64_t>& s : m_sums)
            std::transform(sum.begin(), sum.end(), s.begin(), sum.begin(), std::plus<>());
        std::vector<double> result(m_nodes);
        std::transform(sum.begin(), sum.end(), result.begin(),
                       [&](std::int64_t k) { return double(k) / m_scale; });
        return result;
    }

private:
    std::uint32_t m_nodes;
    tbb::enumerable_thread_specific<std::vector<std::int64_t>> m_sums;
    double m_scale = 1;
};

/// Histogram of the priorities of all refinements of all caches, in steps of less than 1 %: bins
/// are the upper half of a positive float's bits.
using PriorityHistogram = std::vector<std::uint64_t>;

std::uint32_t stepOf(float priority) {
    if (!(priority > 0)) // of -0 and of NaN it would lie beyond the histogram
        return 0;
    return std::bit_cast<std::uint32_t>(priority) >> 16;
}

/// The priority above which there are at most `budget` refinements.
float boundFor(const PriorityHistogram& histogram, std::uint64_t budget) {
    std::uint64_t used = 0;
    auto step = std::uint32_t(histogram.size());
    while (step > 0 && used + histogram[step - 1] <= budget)
        used += histogram[--step];
    // Just below the lowest step taken, so that all of it lies above.
    return step == 0 ? -1 : std::nextafter(std::bit_cast<float>(step << 16), -1.f);
}

/// Fills `choices` per cache with CacheLinker::weigh(), the priority times the root of the cache's
/// weight, since it is an error that is not squared, and finds the bound on the priority that gives
/// all caches together as many links as n_L each would. Returns std::nullopt when cancelled. What a
/// cache saw is not stored: it would take 24 bytes a leaf, more than anything else in a bake, and
/// looking again is as fast as reading it back.
std::optional<float> sharedBound(tbb::enumerable_thread_specific<CacheLinker>& linkers,
                                 const Caches& caches, const CachePoints& points,
                                 const CutSettings& settings, const Progress& progress,
                                 std::vector<CutChoices>& choices) {
    constexpr std::size_t kSteps = 1 << 15;
    tbb::enumerable_thread_specific<PriorityHistogram> histograms(PriorityHistogram(kSteps, 0));
    std::atomic<std::uint64_t> budget = 0;
    const bool done = parallelRanges(
        caches.size(), 8, progress, "budget", [&](std::size_t begin, std::size_t end) {
            CacheLinker& linker = linkers.local();
            PriorityHistogram& histogram = histograms.local();
            for (std::size_t c = begin; c < end; ++c) {
                if (!linker.findVisible(caches, std::uint32_t(c)))
                    continue;
                budget += std::min(linker.leaves(), settings.links) - 1;
                choices[c] = linker.weigh();
                const float weight = std::sqrt(points.weightOf(c));
                for (float& w : choices[c].priority) {
                    w *= weight;
                    ++histogram[stepOf(w)];
                }
            }
        });
    if (!done)
        return {};
    PriorityHistogram sum(kSteps, 0);
    for (const PriorityHistogram& h : histograms)
        std::transform(sum.begin(), sum.end(), h.begin(), sum.begin(), std::plus<>());
    return boundFor(sum, budget);
}

} // namespace

std::vector<float> leafImportance(const Surfels& surfels, const GatherHits& hits,
                                  const CachePoints& points, const Caches& caches,
                                  const ClusterTree& tree) {
    const SumsOfSenders sums =
        sumOverCaches(std::uint32_t(caches.size()), tree.leaves(),
                      [&](std::uint32_t begin, std::uint32_t end, std::span<double> importance) {
                          forEachSeenHit(hits, points, caches, begin, end,
                                         [&](std::uint32_t, std::uint32_t, std::uint32_t sender,
                                             double weight) { importance[sender] += weight; });
                          for (std::uint32_t c = begin; c < end; ++c) {
                              const auto weight = double(points.weightOf(c));
                              const auto add = [&](std::uint32_t sender,
                                                   const FormFactor& formFactor, float = 0) {
                                  importance[sender] += weight * double(formFactor.irradiance);
                              };
                              forEachSkyHit(hits, points, caches, c, add);
                              forEachAimedSample(surfels, hits, points, caches, c, add);
                          }
                      });
    const std::span<const double> all = sums.before(SumsOfSenders::kParts);
    return {all.begin(), all.end()};
}

void weighByImportance(const std::vector<float>& importance, ClusterTree& tree) {
    std::vector<double> sum(importance.begin(), importance.end());
    sum.resize(tree.size());
    for (std::size_t k = 0; k < tree.left.size(); ++k) {
        const double l = sum[tree.left[k]], r = sum[tree.right[k]];
        sum[tree.leaves() + k] = l + r;
        if (l + r > 0)
            tree.leftWeight[k] = float(l / (l + r));
    }
}

void weighByLinks(const std::vector<float>& importance, const std::vector<double>& linked,
                  ClusterTree& tree) {
    // A node's importance less that of the links to it, or to nodes below it, is what links to
    // nodes above it read.
    std::vector<double> all(importance.begin(), importance.end()), below = linked;
    all.resize(tree.size());
    for (std::size_t k = 0; k < tree.left.size(); ++k) {
        const std::uint32_t l = tree.left[k], r = tree.right[k],
                            node = tree.leaves() + std::uint32_t(k);
        all[node] = all[l] + all[r];
        const double left = std::max(all[l] - below[l], 0.),
                     right = std::max(all[r] - below[r], 0.);
        constexpr double kMinimum = 1e-4; // less is rounding
        if (left + right > kMinimum * all[node])
            tree.leftWeight[k] = float(left / (left + right));
        below[node] += below[l] + below[r];
    }
}

bool buildLinks(const Surfels& surfels, const ClusterTree& tree, const GatherHits& hits,
                const CachePoints& points, const TrainingLight& training,
                const CutSettings& settings, const Progress& progress, Caches& caches,
                std::vector<double>* linked) {
    constexpr std::uint32_t kMaxOfBudget = 16; // a cache has at most this many times n_L links
    const LinkInput input{surfels,
                          hits,
                          points,
                          training,
                          settings,
                          SenderOrder(tree),
                          skyNodes(tree),
                          unrotatedRays(hits.rays, CacheKind::Hemisphere),
                          unrotatedRays(hits.rays, CacheKind::Grid)};
    tbb::enumerable_thread_specific<CacheLinker> linkers([&] { return CacheLinker(input); });
    const bool shared = settings.criterion == CutCriterion::Detail;
    std::vector<CutChoices> choices(shared ? caches.size() : 0);
    float bound = -1;
    std::uint32_t maxLinks = settings.links;
    if (shared) {
        const auto found = sharedBound(linkers, caches, points, settings, progress, choices);
        if (!found)
            return false;
        bound = *found;
        maxLinks *= kMaxOfBudget;
    }
    std::vector<PackedLinks> links(caches.size());
    std::optional<ReadSums> reads;
    if (linked)
        reads.emplace(tree.size(), points, caches.size());
    const bool done =
        parallelRanges(caches.size(), 8, progress, "cut", [&](std::size_t begin, std::size_t end) {
            CacheLinker& linker = linkers.local();
            for (std::size_t i = begin; i < end; ++i) {
                const auto c = std::uint32_t(i);
                if (!linker.findVisible(caches, c))
                    continue;
                links[c] =
                    linker.link(caches, c, shared ? choices[c] : linker.weigh(), bound, maxLinks);
                if (reads)
                    reads->add(linker, points.weightOf(c));
                if (shared)
                    choices[c] = {};
            }
        });
    if (!done)
        return false;
    joinLinks(links, caches);
    if (linked)
        *linked = reads->sum();
    return true;
}

} // namespace limn
