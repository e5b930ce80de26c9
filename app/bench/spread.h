// SPDX-License-Identifier: MIT
#pragma once

#include "engine/json/json.h"

#include <string>
#include <vector>

namespace limn {

struct Spread {
    double median = 0, p95 = 0;
};
/// Median and 95th percentile. Precondition: `values` is not empty.
Spread spreadOf(std::vector<double> values);

/// Adds "NAME_median_ms" and "NAME_p95_ms" to a row; without a name "median_ms" and "p95_ms".
void addSpread(Json& row, const std::string& name, const std::vector<double>& ms);

} // namespace limn
