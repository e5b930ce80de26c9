// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/field_rule.h"
#include "engine/techniques/sparse_probes/compressed_transport.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace limn {

/// Whether each receiver is named once.
inline bool namesEachOnce(const std::vector<std::uint32_t>& receivers) {
    std::vector<bool> named(receivers.size());
    return std::ranges::all_of(receivers, [&](std::uint32_t r) {
        const bool fresh = r < named.size() && !named[r];
        if (fresh)
            named[r] = true;
        return fresh;
    });
}

/// Whether the matrices of every cluster have the sizes that its rank says.
inline bool matricesFit(const CompressedTransport& t, std::uint64_t coefficients) {
    for (std::size_t c = 0; c < t.clusters(); ++c) {
        const std::uint64_t receivers = t.receiverBegin[c + 1] - t.receiverBegin[c],
                            probes = t.probeBegin[c + 1] - t.probeBegin[c];
        if (receivers > kMaxClusterReceivers || t.rank[c] > receivers ||
            t.leftBegin[c + 1] - t.leftBegin[c] != receivers * t.rank[c] ||
            t.rightBegin[c + 1] - t.rightBegin[c] != probes * coefficients * t.rank[c])
            return false;
    }
    return true;
}

/// Lists the fields of a CompressedTransport of that many receivers, probes and coefficients, with
/// their rules. It may be empty.
template <class A, class C>
void compressedFields(A& a, C& c, std::uint64_t receivers, std::uint64_t probes,
                      std::uint64_t coefficients) {
    // A singular vector has the length 1. A row of R is at most as long as T, of at most 256 rows
    // of eight probes that share a weight of 1.
    constexpr std::uint16_t kLargestLeft = 0x3c10, kLargestRight = 0x6400; // halfs of 1.02 and 1024
    const auto below = [](const char* words, std::uint16_t largest) {
        return rule::each(words, [largest](std::size_t, std::uint16_t half) {
            return (half & 0x7fff) <= largest;
        });
    };
    const auto offsetsInto = [&c](const auto& elements) {
        return rule::holds("offsets that do not cover what they should",
                           [&c, n = std::uint64_t(elements.size())](const auto& begin) {
                               if (c.rank.empty())
                                   return begin.empty() && n == 0;
                               return begin.size() == c.rank.size() + 1 && begin.front() == 0 &&
                                      begin.back() == n && std::ranges::is_sorted(begin);
                           });
    };
    a("receiver", c.receiver, rule::noneOr(receivers),
      rule::holds("not each receiver once", namesEachOnce));
    a("probe", c.probe, rule::below(probes));
    a("left", c.left, below("longer than a singular vector", kLargestLeft));
    a("right", c.right, below("more light than there is", kLargestRight));
    a("rank", c.rank, rule::holds("without receivers", [&c](const auto& rank) {
          return rank.empty() == c.receiver.empty();
      }));
    a("receiverBegin", c.receiverBegin, offsetsInto(c.receiver));
    a("probeBegin", c.probeBegin, offsetsInto(c.probe));
    a("leftBegin", c.leftBegin, offsetsInto(c.left));
    a("rightBegin", c.rightBegin, offsetsInto(c.right),
      rule::holds("matrices of other sizes",
                  [&c, coefficients](const auto&) { return matricesFit(c, coefficients); }));
}

} // namespace limn
