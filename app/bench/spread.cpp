// SPDX-License-Identifier: MIT
#include "app/bench/spread.h"

#include <algorithm>

namespace limn {

Spread spreadOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto quantile = [&](double share) {
        return values[std::min(values.size() - 1, std::size_t(share * double(values.size())))];
    };
    return {quantile(0.5), quantile(0.95)};
}

void addSpread(Json& row, const std::string& name, const std::vector<double>& ms) {
    const Spread spread = spreadOf(ms);
    const std::string key = name.empty() ? name : name + "_";
    row[key + "median_ms"] = spread.median;
    row[key + "p95_ms"] = spread.p95;
}

} // namespace limn
