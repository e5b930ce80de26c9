// SPDX-License-Identifier: MIT
#include "engine/core/parallel.h"

#include "engine/core/flush_denormals.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <mutex>

#if defined(__SANITIZE_THREAD__)
extern "C" {
void __tsan_acquire(void* address);
void __tsan_release(void* address);
}
#endif

namespace limn {

namespace {

/// Tells ThreadSanitizer about the ordering inside oneTBB that it cannot see: what the caller wrote
/// is visible to the loop's bodies, and what they wrote is visible after the loop. Does nothing in
/// other builds.
class LoopOrder {
public:
    LoopOrder() { released(m_started); }
    ~LoopOrder() { acquired(m_ended); }
    LoopOrder(const LoopOrder&) = delete;
    LoopOrder& operator=(const LoopOrder&) = delete;

    /// Exists for the duration of one call of the body.
    struct Body {
        LoopOrder& loop;
        explicit Body(LoopOrder& order) : loop(order) { acquired(loop.m_started); }
        ~Body() { released(loop.m_ended); }
        Body(const Body&) = delete;
        Body& operator=(const Body&) = delete;
    };

private:
#if defined(__SANITIZE_THREAD__)
    static void acquired(char& flag) {
        __tsan_acquire(&flag);
    }
    static void released(char& flag) {
        __tsan_release(&flag);
    }
#else
    static void acquired(char&) {}
    static void released(char&) {}
#endif
    char m_started = 0, m_ended = 0;
};

} // namespace

void parallelRanges(std::size_t count, std::size_t grain, RangeBody body) {
    if (count == 0)
        return;
    LoopOrder order;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, std::max<std::size_t>(grain, 1)),
                      [&](const tbb::blocked_range<std::size_t>& r) {
                          const LoopOrder::Body ordered(order);
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
    LoopOrder order;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, blocks, 1),
        [&](const tbb::blocked_range<std::size_t>& r) {
            const LoopOrder::Body ordered(order);
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
