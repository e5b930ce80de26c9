// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace limn {

/// What a choice costs, in any unit, and the error that it has.
struct CostAndError {
    double cost = 0, error = 0;
};

/// The choices for which no other one costs at most as much and has at most its error: their
/// indices by rising cost, so that errors fall. Of equal choices the first counts. Choices that
/// are not finite are never among them.
std::vector<std::size_t> paretoLine(std::span<const CostAndError> choices);

} // namespace limn
