// SPDX-License-Identifier: MIT
#include "engine/core/parallel.h"

#include "engine/core/flush_denormals.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <mutex>

namespace limn {

void parallelRanges(std::size_t count, std::size_t grain, RangeBody body) {
    if (count == 0)
        return;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, std::max<std::size_t>(grain, 1)),
                      [&](const tbb::blocked_range<std::size_t>& r) {
                          const FlushDenormals flush;
                          body(r.begin(), r.end());
                      });
}

bool parallelRanges(std::size_t count, std::size_t grain, const Progress& progress,
                    const char* stage, RangeBody body) {
    progress.at(stage, 0);
    std::atomic<std::size_t> done = 0;
    std::atomic<bool> stopped = false;
    std::mutex reporting;
    grain = std::max<std::size_t>(grain, 1);
    const std::size_t blocks = (count + grain - 1) / grain;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, blocks, 1),
        [&](const tbb::blocked_range<std::size_t>& r) {
            const FlushDenormals flush;
            for (std::size_t block = r.begin(); block != r.end(); ++block) {
                if (progress.cancelled()) {
                    stopped = true;
                    return;
                }
                const std::size_t begin = block * grain, end = std::min(begin + grain, count);
                body(begin, end);
                const std::size_t now = done += end - begin;
                if (const std::unique_lock lock(reporting, std::try_to_lock); lock)
                    progress.at(stage, float(now) / float(count));
            }
        },
        tbb::simple_partitioner());
    return !stopped && !progress.cancelled();
}

struct ThreadLimit::Control {
    tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads)
    : m_control(threads > 0
                    ? new Control{tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                                      std::size_t(threads))}
                    : nullptr) {}

ThreadLimit::~ThreadLimit() {
    delete m_control;
}

} // namespace limn
