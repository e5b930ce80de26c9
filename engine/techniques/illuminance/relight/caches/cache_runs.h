// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"

#include <cstdint>
#include <vector>

namespace limn {

/// A set of lightmap caches, one byte for each: 1 for those that are in it.
using CacheFlags = std::vector<std::uint8_t>;

/// The caches [begin, end).
struct CacheRun {
    std::uint32_t begin, end;
    bool operator==(const CacheRun&) const = default;
};

/// Ascending, none empty, none longer than kLongestRun: so they are shared out evenly to threads.
using CacheRuns = std::vector<CacheRun>;
inline constexpr std::uint32_t kLongestRun = 64;

/// [begin, end) in runs.
CacheRuns runsOf(std::uint32_t begin, std::uint32_t end);

/// Sets `runs` to the caches that `flags` has.
void setRuns(const CacheFlags& flags, CacheRuns& runs);

/// The lightmap caches that some surfel reads with a weight above 0. Bounces need no others.
CacheFlags cachesRead(const Surfels& surfels, const Caches& caches);

/// Sets `missing` to those of `seen`, or all where it is null, with what fills invalid ones among
/// them, that `current` has not.
void setMissing(const Caches& caches, const CacheFlags& current, const CacheFlags* seen,
                CacheFlags& missing);

/// Takes those of `other` away from `flags`.
void removeFrom(CacheFlags& flags, const CacheFlags& other);

/// Adds to `flags` the valid caches that stand in for invalid ones among them.
void addFillSources(const Caches& caches, CacheFlags& flags);

} // namespace limn
