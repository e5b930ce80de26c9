// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"

#include <atomic>
#include <optional>
#include <thread>

namespace limn {

/// Cancels jobs once a time is over. Must outlive the jobs.
class TimeLimit {
public:
    /// std::nullopt: never. `seconds` counts from now.
    explicit TimeLimit(std::optional<double> seconds);

    bool over() const { return m_over; }

    /// `shown`, cancelled when the time is over.
    Progress progress(Progress shown = {}) const;

private:
    std::atomic<bool> m_over = false;
    std::jthread m_watch;
};

} // namespace limn
