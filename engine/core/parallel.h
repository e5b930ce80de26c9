// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"

#include <cstddef>

namespace limn {

/// Non-owning reference to a callable (begin, end), which must outlive it. Never allocates.
class RangeBody {
public:
    template <class Body>
    RangeBody(const Body& body)
        : m_body(&body), m_call([](const void* b, std::size_t begin, std::size_t end) {
              (*static_cast<const Body*>(b))(begin, end);
          }) {}
    void operator()(std::size_t begin, std::size_t end) const { m_call(m_body, begin, end); }

private:
    const void* m_body;
    void (*m_call)(const void*, std::size_t, std::size_t);
};

/// Calls body(begin, end) over disjoint ranges that cover [0, count), on oneTBB's threads.
/// `grain` is the smallest range worth a task. Bodies write only to their own range, so results do
/// not depend on the number of threads. They run under FlushDenormals, on the calling thread too.
void parallelRanges(std::size_t count, std::size_t grain, RangeBody body);

/// Same, with progress of `stage` and cancellation between ranges of `grain` items. Returns false
/// when cancelled; the work is then incomplete.
bool parallelRanges(std::size_t count, std::size_t grain, const Progress& progress,
                    const char* stage, RangeBody body);

/// Limits oneTBB to `threads` (0: all of the machine's) for as long as the object lives.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    struct Control;
    Control* m_control;
};

} // namespace limn
