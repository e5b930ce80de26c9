// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace limn {

/// A step of an update of bounced light and its duration.
struct LightingStep {
    const char* id; ///< in JSON, snake case
    const char *label, *tooltip;
    double ms = 0;
};

enum class CounterUnit : std::uint8_t { Count, Milliseconds, Share, Bytes };

/// A quantity that an update or a precomputation counted.
struct LightingCounter {
    const char* id; ///< in JSON, snake case
    const char *label, *tooltip;
    double value = 0;
    CounterUnit unit = CounterUnit::Count;
};

/// What an update of bounced light did, as printed by the statistics panel and --json.
struct LightingReport {
    std::vector<LightingStep> steps;       ///< in the order they run
    std::vector<LightingCounter> counters; ///< of the last update, including what it skipped
    double totalMs = 0;                    ///< from call to return
    std::uint32_t bounces = 0;             ///< number of bounces that the update added
    bool converged = false;                ///< another bounce would change next to nothing
    bool skipped = false;                  ///< nothing was out of date, so no work was done
    bool diverges = false;       ///< bounces were stopped because they kept adding more light
    const char* lacks = nullptr; ///< what the light lacks, a clause for people; null: nothing
    bool whole = true;           ///< all light is up to date, not only what the view shows
};

/// Value of the counter with that id; 0 if there is none.
inline double counterOf(const std::vector<LightingCounter>& counters, std::string_view id) {
    for (const LightingCounter& counter : counters)
        if (counter.id == id)
            return counter.value;
    return 0;
}
inline double counterOf(const LightingReport& report, std::string_view id) {
    return counterOf(report.counters, id);
}

} // namespace limn
