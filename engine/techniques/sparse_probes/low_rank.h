// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace limn {

/// A matrix of `rows` x `columns` as the product of two narrow ones, both row by row.
struct LowRank {
    std::size_t rank = 0;
    std::vector<double> left;  ///< rows x rank, its columns orthonormal
    std::vector<double> right; ///< rank x columns
};

/// The product of smallest rank that loses at most `error` of the matrix's norm (Frobenius).
/// `matrix` holds rows * columns finite numbers row by row, with few rows: the singular vectors are
/// eigenvectors of the matrix times its transpose (Eckart, Young. The Approximation of One Matrix
/// by Another of Lower Rank. 1936).
LowRank lowRank(std::span<const double> matrix, std::size_t rows, double error);

} // namespace limn
