// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"

#include <cstdint>
#include <vector>

namespace limn {

/// A set of lightmap caches, with one byte for each: 1 for those in the set.
using CacheFlags = std::vector<std::uint8_t>;

/// The caches [begin, end).
struct CacheRun {
    std::uint32_t begin, end;
    bool operator==(const CacheRun&) const = default;
};

/// Runs in ascending order, none empty and none longer than kLongestRun, so that they divide evenly
/// among threads.
using CacheRuns = std::vector<CacheRun>;
inline constexpr std::uint32_t kLongestRun = 64;

/// Splits the caches [begin, end) into runs.
CacheRuns runsOf(std::uint32_t begin, std::uint32_t end);

/// Sets `runs` to the caches in `flags`.
void setRuns(const CacheFlags& flags, CacheRuns& runs);

/// The lightmap caches that some surfel reads with a weight above 0, and the sources of invalid
/// ones among them. Bounces need no others.
CacheFlags cachesRead(const Surfels& surfels, const Caches& caches);

/// Sets `missing` to the caches of `seen` (null: all), and the sources of invalid ones among them,
/// that are not in `current`.
void setMissing(const Caches& caches, const CacheFlags& current, const CacheFlags* seen,
                CacheFlags& missing);

/// Removes the caches of `other` from `flags`.
void removeFrom(CacheFlags& flags, const CacheFlags& other);

/// Adds to `flags` the valid caches that stand in for invalid ones among them.
void addFillSources(const Caches& caches, CacheFlags& flags);

} // namespace limn
