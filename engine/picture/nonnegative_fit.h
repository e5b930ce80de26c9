// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace limn {

/// A system of linear equations, row after row.
struct LinearSystem {
    std::size_t unknowns = 0;
    std::vector<double> matrix; ///< `unknowns` numbers for each equation
    std::vector<double> right;  ///< one for each equation
};

/// The unknowns, all >= 0, with the least sum of squared differences between both sides. All
/// numbers must be finite, and the columns linearly independent. Lawson, Hanson. Solving Least
/// Squares Problems. 1974, Section 23.3
std::vector<double> nonnegativeFit(const LinearSystem& system);

} // namespace limn
