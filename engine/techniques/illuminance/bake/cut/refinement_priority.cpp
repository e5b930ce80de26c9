// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/cut/refinement_priority.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace limn {

namespace {

constexpr std::uint32_t kLightings = TrainingLight::kCount;

/// Mean square radiosity by which the halves of a cluster may differ though no training lighting
/// shows it; they are scaled to a mean square of 1. Without it, clusters that all of them leave
/// dark would never be split, and light unlike any of them, such as an even sky through small
/// windows, would fare worse than with the paper's cut; with more of it, light leaks through walls
/// as with that. Error of the cut, agglomerative trees of 16 384 surfels, at 64 links with 0.003,
/// 0.03, 0.1, and with the paper's: a living room under an even sky 0.034, 0.016, 0.013, 0.015;
/// sunlit Sponza 0.178, 0.207, 0.227, 0.310; Cornell with a lamp 0.034, 0.036, 0.038, 0.056. Leaks
/// into a sealed room, as a share of the paper's: 1/12, 1/5.3, 1/3.1.
constexpr float kPrior = 0.03f;

/// Errors are weighted relative to the cache's irradiance in each lighting, so that a dark room is
/// as accurate in proportion as a bright one: a viewer inside it sees only the dark room. Below
/// this fraction of the lighting's usual irradiance they are weighted relative to the fraction
/// instead. With absolute weights, a room lit through the gap of a door came out 2.7 times too
/// bright at 128 links, because its links led to clusters that had surfels in both rooms.
constexpr float kDarkest = 0.01f;

/// Expected squared error of a link by the prior, less what all links to the same senders have in
/// common. The senders' radiosities B_k count as independent with variance kPrior / 2, so that the
/// mean square of the difference of two is kPrior. The cache sees the senders with form factors F_k
/// of sum `formFactor`. The link reads a mean of senders whose form factors sum to `seen`; its
/// weights have the sum of squares `squares`. If these weights are equal, `squares` is their value,
/// too, and the variance of sum(F_k B_k) - formFactor * mean is kPrior / 2 * sum(F_k^2) plus what
/// is returned.
float priorError(float formFactor, float seen, float squares) {
    return kPrior / 2 * formFactor * (formFactor - 2 * seen) * squares;
}

} // namespace

void RefinementPriority::bySolidAngle(const VisibleTree& seen) {
    m_choices.priority.clear();
    for (std::uint32_t i = seen.leaves(); i < seen.size(); ++i)
        m_choices.priority.push_back(seen.formFactor[i].solidAngle);
    m_choices.representative.assign(m_choices.priority.size(), Representative::Cluster);
}

void RefinementPriority::weighLightings(const VisibleTree& seen, const TrainingLight& training) {
    const LightingRow E = receivedFrom(training, std::span(seen.node).first(seen.leaves()),
                                       std::span(seen.formFactor).first(seen.leaves()));
    float formFactor = 0;
    for (std::uint32_t i = 0; i < seen.leaves(); ++i)
        formFactor += seen.formFactor[i].irradiance;
    m_weight.resize(kLightings + 1);
    for (std::uint32_t t = 0; t < kLightings; ++t) {
        const float usual = TrainingLight::strength(t), relative = E[t] / usual;
        m_weight[t] = 1 / (relative * relative + kDarkest * kDarkest);
    }
    m_weight[kLightings] = 1 / (formFactor * formFactor + kDarkest * kDarkest);
}

void RefinementPriority::byDetail(const VisibleTree& seen, const TrainingLight& training) {
    weighLightings(seen, training);
    measureGains(seen, training);
    joinGroups(seen);
    std::vector<float>& priority = m_choices.priority;
    priority.resize(m_groups.size());
    for (std::size_t i = m_groups.size(); i-- > 0;) // a group comes before the one that took it in
        priority[i] = m_groups[i].joined != kNone ? priority[m_groups[i].joined]
                                                  : std::max(m_groups[i].priority(), 0.f);
}

void RefinementPriority::measureGains(const VisibleTree& seen, const TrainingLight& training) {
    m_error.assign(seen.size(), 0);
    m_groups.assign(seen.size() - seen.leaves(), Group{});
    m_choices.representative.assign(m_groups.size(), Representative::Cluster);
    m_read.clear();
    for (std::uint32_t i = 0; i < seen.size(); ++i)
        m_read.push_back({seen.node[i], seen.formFactor[i].irradiance});
    // Inner nodes come in post-order, so the right inner child's contribution lies on top of the
    // stack.
    std::size_t depth = 0;
    const auto received = [&](std::uint32_t node) -> Received {
        if (node >= seen.leaves())
            return {1, m_contribution.data() + --depth * kLightings};
        return {seen.formFactor[node].irradiance, training.row(seen.node[node])};
    };
    // The rows lie far apart in memory, so they are prefetched some nodes ahead.
    const auto fetch = [&](std::uint32_t node) {
        constexpr std::uint32_t kPerLine = 64 / sizeof(float);
        const float* row = training.row(seen.node[node]);
        for (std::uint32_t t = 0; t < kLightings; t += kPerLine)
            __builtin_prefetch(row + t);
    };
    constexpr std::uint32_t kAhead = 4;
    for (std::uint32_t i = seen.leaves(); i < seen.size(); ++i) {
        if (const std::uint32_t next = i + kAhead; next < seen.size()) {
            fetch(next);
            for (int side = 0; side < 2; ++side)
                if (const std::uint32_t c = seen.child(next, side); c < seen.leaves())
                    fetch(c);
        }
        const std::uint32_t l = seen.child(i, 0), r = seen.child(i, 1);
        const Received right = received(r), left = received(l);
        LightingRow contribution;
        const auto errors = linkErrors(left, right, seen.formFactor[i].irradiance,
                                       {training.row(seen.node[i]), training.row(m_read[l].node),
                                        training.row(m_read[r].node)},
                                       m_weight.data(), contribution.data());
        chooseRepresentative(seen, training, i, errors);
        if (m_contribution.size() < (depth + 1) * kLightings)
            m_contribution.resize((depth + 1) * kLightings);
        std::ranges::copy(contribution, m_contribution.data() + depth++ * kLightings);
        m_groups[i - seen.leaves()].gain = m_error[i] - m_error[l] - m_error[r] +
                                           kPrior * m_weight[kLightings] *
                                               seen.formFactor[l].irradiance *
                                               seen.formFactor[r].irradiance;
    }
}

/// Fills m_error and m_read of inner node `i`. `errors`: of each Representative.
void RefinementPriority::chooseRepresentative(const VisibleTree& seen,
                                              const TrainingLight& training, std::uint32_t i,
                                              const std::array<float, kLinkCandidates>& errors) {
    const float formFactor = seen.formFactor[i].irradiance;
    float minimum = std::numeric_limits<float>::infinity();
    const auto consider = [&](Representative choice, const Read& read) {
        const float error = errors[std::size_t(choice)];
        const float expected =
            error + m_weight[kLightings] *
                        priorError(formFactor, read.seen, training.squaredWeights[read.node]);
        if (!(expected < minimum))
            return;
        minimum = expected;
        m_error[i] = error;
        m_read[i] = read;
        m_choices.representative[i - seen.leaves()] = choice;
    };
    consider(Representative::Cluster, {seen.node[i], formFactor});
    consider(Representative::Left, m_read[seen.child(i, 0)]);
    consider(Representative::Right, m_read[seen.child(i, 1)]);
}

/// A group takes in the best group below it for as long as that has a higher priority than itself.
void RefinementPriority::joinGroups(const VisibleTree& seen) {
    for (std::uint32_t i = 0; i < m_groups.size(); ++i) {
        std::uint32_t below = kNone;
        for (int side = 0; side < 2; ++side)
            if (const std::uint32_t c = seen.child(i + seen.leaves(), side); c >= seen.leaves())
                below = merge(below, c - seen.leaves());
        Group& group = m_groups[i];
        while (below != kNone && m_groups[below].priority() >= group.priority()) {
            Group& best = m_groups[below];
            group.gain += best.gain;
            group.count += best.count;
            best.joined = i;
            below = merge(merge(best.left, best.right), best.below);
        }
        group.below = below;
    }
}

std::uint32_t RefinementPriority::rankOf(std::uint32_t heap) const {
    return heap == kNone ? 0 : m_groups[heap].rank;
}

/// Merges two leftist heaps with the highest priority on top. Crane. Linear Lists and Priority
/// Queues as Balanced Binary Trees. 1972
std::uint32_t RefinementPriority::merge(std::uint32_t a, std::uint32_t b) {
    if (a == kNone || b == kNone)
        return a == kNone ? b : a;
    if (std::pair(m_groups[b].priority(), b) > std::pair(m_groups[a].priority(), a))
        std::swap(a, b);
    const std::uint32_t right = merge(m_groups[a].right, b);
    Group& top = m_groups[a];
    top.right = right;
    if (rankOf(top.left) < rankOf(top.right))
        std::swap(top.left, top.right);
    top.rank = rankOf(top.right) + 1;
    return a;
}

} // namespace limn
