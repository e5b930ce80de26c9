// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace limn {

/// A part of an update of bounced light, and what it took.
struct LightingStep {
    const char* id; ///< in JSON, snake case
    const char *label, *tooltip;
    double ms = 0;
};

enum class CounterUnit : std::uint8_t { Count, Milliseconds, Share };

/// Something that an update counted.
struct LightingCounter {
    const char* id; ///< in JSON, snake case
    const char *label, *tooltip;
    double value = 0;
    CounterUnit unit = CounterUnit::Count;
};

/// What an update of bounced light did, as the statistics panel and --json print it.
struct LightingReport {
    std::vector<LightingStep> steps;       ///< in the order they run
    std::vector<LightingCounter> counters; ///< of the last update; what it skipped among them
    double totalMs = 0;                    ///< from call to return
    std::uint32_t bounces = 0;             ///< that the update added
    bool converged = false;                ///< another bounce would change next to nothing
    bool skipped = false;                  ///< nothing was out of date: no work was done
    bool diverges = false; ///< bounces were stopped because they brought ever more light
    bool whole = true;     ///< all light is of this update, not only what the view shows
};

/// The value of the counter of that id; 0 where the report has none.
inline double counterOf(const LightingReport& report, std::string_view id) {
    for (const LightingCounter& counter : report.counters)
        if (counter.id == id)
            return counter.value;
    return 0;
}

} // namespace limn
