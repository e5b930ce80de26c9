// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/caches/cache_runs.h"

#include <algorithm>

namespace limn {

CacheRuns runsOf(std::uint32_t begin, std::uint32_t end) {
    CacheRuns runs;
    for (; begin < end; begin += kLongestRun)
        runs.push_back({begin, std::min(begin + kLongestRun, end)});
    return runs;
}

void setRuns(const CacheFlags& flags, CacheRuns& runs) {
    runs.clear();
    for (std::uint32_t c = 0; c < flags.size(); ++c) {
        if (flags[c] == 0)
            continue;
        if (runs.empty() || runs.back().end != c || c - runs.back().begin == kLongestRun)
            runs.push_back({c, c});
        ++runs.back().end;
    }
}

CacheFlags cachesRead(const Surfels& surfels, const Caches& caches) {
    CacheFlags read(caches.lightmapCount, 0);
    for (std::size_t i = 0; i < surfels.size(); ++i)
        for (int k = 0; k < 4; ++k)
            if (surfels.cacheWeight[i][k] > 0 && surfels.cache[i][k] < caches.lightmapCount)
                read[surfels.cache[i][k]] = 1;
    addFillSources(caches, read);
    return read;
}

void setMissing(const Caches& caches, const CacheFlags& current, const CacheFlags* seen,
                CacheFlags& missing) {
    if (seen != nullptr)
        missing = *seen;
    else
        missing.assign(current.size(), 1);
    addFillSources(caches, missing);
    removeFrom(missing, current);
}

void removeFrom(CacheFlags& flags, const CacheFlags& other) {
    for (std::size_t c = 0; c < flags.size(); ++c)
        flags[c] &= other[c] == 0;
}

void addFillSources(const Caches& caches, CacheFlags& flags) {
    for (std::uint32_t c = 0; c < caches.lightmapCount; ++c)
        for (std::uint32_t k = caches.fillBegin[c]; flags[c] != 0 && k < caches.fillBegin[c + 1];
             ++k)
            flags[caches.fillSource[k]] = 1;
}

} // namespace limn
