// SPDX-License-Identifier: MIT
#include "engine/lighting/precomputed.h"

namespace limn {

double totalOf(const std::vector<LightingCounter>& counters) {
    double total = 0;
    for (const LightingCounter& counter : counters)
        total += counter.value;
    return total;
}

double totalOf(const StageSeconds& seconds) {
    double total = 0;
    for (const auto& [stage, s] : seconds)
        total += s;
    return total;
}

} // namespace limn
