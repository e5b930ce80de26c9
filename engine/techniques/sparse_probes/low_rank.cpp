// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/low_rank.h"

#include <algorithm>

#include <Eigen/Eigenvalues>

namespace limn {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Smallest rank of which at most `error` of the norm is lost. `squares`: squared singular values,
/// ascending.
static Eigen::Index rankFor(const Eigen::VectorXd& squares, double error) {
    const double allowed = error * error * squares.cwiseMax(0).sum();
    double lost = 0;
    Eigen::Index kept = squares.size();
    while (kept > 0) {
        lost += std::max(squares[squares.size() - kept], 0.);
        if (lost > allowed)
            break;
        --kept;
    }
    return kept;
}

LowRank lowRank(std::span<const double> matrix, std::size_t rows, double error) {
    if (matrix.empty())
        return {};
    const auto height = Eigen::Index(rows), width = Eigen::Index(matrix.size() / rows);
    const Matrix m = Eigen::Map<const Matrix>(matrix.data(), height, width);
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(m * m.transpose());
    const Eigen::Index rank = rankFor(solver.eigenvalues(), error);
    const Matrix left = solver.eigenvectors().rightCols(rank);
    const Matrix right = left.transpose() * m;
    return {.rank = std::size_t(rank),
            .left = {left.data(), left.data() + left.size()},
            .right = {right.data(), right.data() + right.size()}};
}

} // namespace limn
