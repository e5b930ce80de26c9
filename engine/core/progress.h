// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>

namespace limn {

/// Progress reports and cancellation of a long job. Default-constructed: silent, never cancelled.
/// May be called from any thread, one call at a time per job.
struct Progress {
    /// `stage` is a short noun ("surfels", "trace"); `fraction` in [0, 1] of that stage.
    std::function<void(const char* stage, float fraction)> report;
    /// Set by the owner to ask the job to stop; polled at least every 100 ms of work. May be null.
    const std::atomic<bool>* cancel = nullptr;

    bool cancelled() const { return cancel && cancel->load(std::memory_order_relaxed); }
    void at(const char* stage, float fraction) const {
        if (report)
            report(stage, fraction);
    }
};

} // namespace limn
