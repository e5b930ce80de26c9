// SPDX-License-Identifier: MIT
#include "engine/measure/pareto_line.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace limn {

std::vector<std::size_t> paretoLine(std::span<const CostAndError> choices) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < choices.size(); ++i)
        if (std::isfinite(choices[i].cost) && std::isfinite(choices[i].error))
            order.push_back(i);
    std::ranges::sort(
        order, {}, [&](std::size_t i) { return std::tuple(choices[i].cost, choices[i].error, i); });
    double least = std::numeric_limits<double>::infinity();
    std::erase_if(order, [&](std::size_t i) {
        if (choices[i].error >= least)
            return true;
        least = choices[i].error;
        return false;
    });
    return order;
}

} // namespace limn
