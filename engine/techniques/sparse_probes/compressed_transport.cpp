// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/compressed_transport.h"

#include "engine/core/parallel.h"
#include "engine/math/packing.h"
#include "engine/techniques/sparse_probes/low_rank.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include <glm/common.hpp>

namespace limn {

namespace {

/// Of the scene's extent: a turn of the normal by a right angle counts as a way of 1.4 times this.
constexpr float kNormalScale = 0.25f;

using Ids = std::span<std::uint32_t>;

/// Halves sets of receivers at the middle of the axis, of six, along which they lie farthest apart.
class Clusters {
public:
    explicit Clusters(const ReceiverPoints& points) : m_points(points) {
        glm::vec3 lower(0), upper(0);
        if (!points.position.empty())
            lower = upper = points.position[0];
        for (const glm::vec3 p : points.position)
            lower = glm::min(lower, p), upper = glm::max(upper, p);
        const glm::vec3 size = upper - lower;
        m_normalScale = kNormalScale * std::max({size.x, size.y, size.z});
    }

    /// Reorders `ids` and appends the end of each cluster, counted from `offset`.
    void split(Ids ids, std::uint32_t offset, std::vector<std::uint32_t>& ends) const {
        if (ids.size() <= kMaxClusterReceivers) {
            ends.push_back(offset + std::uint32_t(ids.size()));
            return;
        }
        const int axis = widestAxis(ids);
        std::ranges::sort(ids, {}, [&](std::uint32_t r) { return std::pair(at(r, axis), r); });
        const std::size_t half = ids.size() / 2;
        split(ids.first(half), offset, ends);
        split(ids.subspan(half), offset + std::uint32_t(half), ends);
    }

private:
    float at(std::uint32_t receiver, int axis) const {
        return axis < 3 ? m_points.position[receiver][axis]
                        : m_normalScale * m_points.normal[receiver][axis - 3];
    }
    int widestAxis(Ids ids) const {
        int widest = 0;
        float maxExtent = -1;
        for (int axis = 0; axis < 6; ++axis) {
            const auto [low, high] =
                std::ranges::minmax(ids, {}, [&](std::uint32_t r) { return at(r, axis); });
            if (const float extent = at(high, axis) - at(low, axis); extent > maxExtent)
                widest = axis, maxExtent = extent;
        }
        return widest;
    }

    const ReceiverPoints& m_points;
    float m_normalScale = 0;
};

/// The compressed matrix of one cluster.
struct Factors {
    std::vector<std::uint16_t> probe, left, right;
    std::uint32_t rank = 0;
};

std::vector<std::uint16_t> probesOf(const Transport& t, std::span<const std::uint32_t> ids) {
    std::vector<std::uint16_t> probes;
    for (const std::uint32_t r : ids)
        for (std::uint32_t k = 0; k < kProbesPerReceiver; ++k)
            if (const std::uint16_t p = t.probe[std::size_t(r) * kProbesPerReceiver + k];
                p != kNoProbe)
                probes.push_back(p);
    std::ranges::sort(probes);
    const auto rest = std::ranges::unique(probes);
    probes.erase(rest.begin(), rest.end());
    return probes;
}

/// The cluster's part of the transport: a row for each receiver, and columns for the coefficients
/// of each probe.
std::vector<double> matrixOf(const Transport& t, std::span<const std::uint32_t> ids,
                             std::span<const std::uint16_t> probes, std::size_t coefficients) {
    const std::size_t columns = probes.size() * coefficients;
    std::vector<double> m(ids.size() * columns);
    for (std::size_t row = 0; row < ids.size(); ++row)
        for (std::uint32_t k = 0; k < kProbesPerReceiver; ++k) {
            const std::size_t from = std::size_t(ids[row]) * kProbesPerReceiver + k;
            if (t.probe[from] == kNoProbe)
                continue;
            const auto probe =
                std::size_t(std::ranges::lower_bound(probes, t.probe[from]) - probes.begin());
            for (std::size_t c = 0; c < coefficients; ++c)
                m[row * columns + probe * coefficients + c] =
                    double(halfToFloat(t.coefficients[from * coefficients + c]));
        }
    return m;
}

std::vector<std::uint16_t> halfsOf(const std::vector<double>& numbers) {
    std::vector<std::uint16_t> halfs(numbers.size());
    std::ranges::transform(numbers, halfs.begin(), [](double v) { return floatToHalf(float(v)); });
    return halfs;
}

/// A cluster has at most kMaxClusterReceivers rows.
Factors factorise(const Transport& t, std::span<const std::uint32_t> ids, std::size_t coefficients,
                  float error) {
    Factors out{.probe = probesOf(t, ids)};
    const LowRank product =
        lowRank(matrixOf(t, ids, out.probe, coefficients), ids.size(), double(error));
    out.rank = std::uint32_t(product.rank);
    out.left = halfsOf(product.left);
    out.right = halfsOf(product.right);
    return out;
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& some) {
    all.insert(all.end(), some.begin(), some.end());
}

/// One cluster of a CompressedTransport.
struct ClusterView {
    ClusterView(const CompressedTransport& t, std::size_t c, std::size_t count)
        : receivers(std::span(t.receiver)
                        .subspan(t.receiverBegin[c], t.receiverBegin[c + 1] - t.receiverBegin[c])),
          probes(
              std::span(t.probe).subspan(t.probeBegin[c], t.probeBegin[c + 1] - t.probeBegin[c])),
          left(t.left.data() + t.leftBegin[c]), right(t.right.data() + t.rightBegin[c]),
          rank(t.rank[c]), coefficients(count) {}

    const std::uint16_t* leftRow(std::size_t receiver) const { return left + receiver * rank; }
    /// The part of row `k` of R that belongs to the cluster's probe `p`.
    const std::uint16_t* rightRow(std::size_t k, std::size_t p) const {
        return right + (k * probes.size() + p) * coefficients;
    }

    std::span<const std::uint32_t> receivers;
    std::span<const std::uint16_t> probes;
    const std::uint16_t *left, *right;
    std::size_t rank, coefficients;
};

using Ranks = std::array<glm::vec3, kMaxClusterReceivers>; // a value for each row of R

/// Adds row k of R times the radiance of the cluster's probe `p` to sum[k], for each k.
void addProbe(const ClusterView& cluster, std::size_t p, std::span<const float> probes,
              Ranks& sum) {
    const std::size_t n = cluster.coefficients;
    const float* probe = &probes[std::size_t(cluster.probes[p]) * 3 * n];
    for (std::size_t k = 0; k < cluster.rank; ++k) {
        const std::uint16_t* row = cluster.rightRow(k, p);
        glm::vec3 part(0);
        for (std::size_t c = 0; c < n; ++c)
            part += halfToFloat(row[c]) * glm::vec3(probe[c], probe[n + c], probe[2 * n + c]);
        sum[k] += part;
    }
}

glm::vec3 ofReceiver(const ClusterView& cluster, std::size_t receiver, const Ranks& ranks) {
    const std::uint16_t* row = cluster.leftRow(receiver);
    glm::vec3 sum(0);
    for (std::size_t k = 0; k < cluster.rank; ++k)
        sum += halfToFloat(row[k]) * ranks[k];
    return sum;
}

} // namespace

std::uint64_t CompressedTransport::bytes() const {
    return sizeof(std::uint32_t) * (receiver.size() + receiverBegin.size() + probeBegin.size()) +
           sizeof(std::uint64_t) * (leftBegin.size() + rightBegin.size()) +
           sizeof(std::uint16_t) * (rank.size() + probe.size() + left.size() + right.size());
}

CompressedTransport compressTransport(const Transport& transport, std::size_t coefficients,
                                      const ReceiverPoints& points, float error,
                                      const Progress& progress) {
    CompressedTransport out;
    out.receiver.resize(points.position.size());
    std::iota(out.receiver.begin(), out.receiver.end(), 0U);
    out.receiverBegin = {0};
    if (!out.receiver.empty())
        Clusters(points).split(out.receiver, 0, out.receiverBegin);
    std::vector<Factors> factors(out.receiverBegin.size() - 1);
    parallelRanges(
        factors.size(), 1, progress, "compression", [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) {
                const std::uint32_t from = out.receiverBegin[c];
                const std::span ids =
                    std::span(out.receiver).subspan(from, out.receiverBegin[c + 1] - from);
                factors[c] = factorise(transport, ids, coefficients, error);
            }
        });
    out.probeBegin = {0};
    out.leftBegin = out.rightBegin = {0};
    for (const Factors& f : factors) {
        out.rank.push_back(std::uint16_t(f.rank));
        append(out.probe, f.probe);
        append(out.left, f.left);
        append(out.right, f.right);
        out.probeBegin.push_back(std::uint32_t(out.probe.size()));
        out.leftBegin.push_back(out.left.size());
        out.rightBegin.push_back(out.right.size());
    }
    return out;
}

void gatherCompressed(const CompressedTransport& transport, std::size_t coefficients,
                      std::span<const float> probes, NotNegative clamped,
                      std::span<glm::vec3> irradiance) {
    parallelRanges(transport.clusters(), 1, [&](std::size_t begin, std::size_t end) {
        Ranks ranks;
        Ranks sums; // of the cluster's receivers
        for (std::size_t c = begin; c < end; ++c) {
            const ClusterView cluster(transport, c, coefficients);
            const std::size_t n = cluster.receivers.size();
            std::fill_n(ranks.begin(), cluster.rank, glm::vec3(0));
            std::fill_n(sums.begin(), n, glm::vec3(0));
            for (std::size_t p = 0; p < cluster.probes.size(); ++p) {
                addProbe(cluster, p, probes, ranks);
                if (clamped != NotNegative::Parts)
                    continue;
                for (std::size_t r = 0; r < n; ++r)
                    sums[r] += glm::max(ofReceiver(cluster, r, ranks), glm::vec3(0));
                std::fill_n(ranks.begin(), cluster.rank, glm::vec3(0));
            }
            for (std::size_t r = 0; r < n; ++r) {
                const glm::vec3 sum = sums[r] + ofReceiver(cluster, r, ranks);
                irradiance[cluster.receivers[r]] =
                    clamped == NotNegative::Nothing ? sum : glm::max(sum, glm::vec3(0));
            }
        }
    });
}

void addTransposed(const CompressedTransport& transport, std::size_t coefficients,
                   std::span<const glm::vec3> receivers, std::span<glm::vec3> probes) {
    Ranks ranks;
    for (std::size_t c = 0; c < transport.clusters(); ++c) {
        const ClusterView cluster(transport, c, coefficients);
        std::fill_n(ranks.begin(), cluster.rank, glm::vec3(0));
        bool any = false;
        for (std::size_t r = 0; r < cluster.receivers.size(); ++r) {
            const glm::vec3 weight = receivers[cluster.receivers[r]];
            if (weight == glm::vec3(0))
                continue;
            any = true;
            for (std::size_t k = 0; k < cluster.rank; ++k)
                ranks[k] += halfToFloat(cluster.leftRow(r)[k]) * weight;
        }
        for (std::size_t p = 0; any && p < cluster.probes.size(); ++p)
            for (std::size_t k = 0; k < cluster.rank; ++k)
                for (std::size_t i = 0; i < coefficients; ++i)
                    probes[cluster.probes[p] * coefficients + i] +=
                        halfToFloat(cluster.rightRow(k, p)[i]) * ranks[k];
    }
}

} // namespace limn
