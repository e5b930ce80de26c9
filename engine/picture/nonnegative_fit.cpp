// SPDX-License-Identifier: MIT
#include "engine/picture/nonnegative_fit.h"

#include <algorithm>
#include <limits>

#include <Eigen/Dense>

namespace limn {

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class ActiveSet {
public:
    explicit ActiveSet(const LinearSystem& system)
        : m_matrix(Eigen::Map<const Matrix>(system.matrix.data(), Eigen::Index(system.right.size()),
                                            Eigen::Index(system.unknowns))),
          m_right(Eigen::Map<const Eigen::VectorXd>(system.right.data(),
                                                    Eigen::Index(system.right.size()))),
          m_x(Eigen::VectorXd::Zero(Eigen::Index(system.unknowns))) {}

    std::vector<double> solve() {
        // Each unknown enters about once; the bound is for roundings that let one go in circles.
        for (Eigen::Index step = 0; step < 3 * m_x.size() && enter(); ++step)
            while (!settle())
                ;
        return {m_x.begin(), m_x.end()};
    }

private:
    /// Frees the unknown at 0 that lowers the sum of squares most. Returns false if none does.
    bool enter() {
        const Eigen::VectorXd descent = m_matrix.transpose() * (m_right - m_matrix * m_x);
        constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();
        Eigen::Index best = -1;
        for (Eigen::Index k = 0; k < m_x.size(); ++k) {
            const double rounding = kRounding * m_matrix.col(k).norm() * m_right.norm();
            if (std::ranges::find(m_free, k) == m_free.end() && descent[k] > rounding &&
                (best < 0 || descent[k] > descent[best]))
                best = k;
        }
        if (best >= 0)
            m_free.push_back(best);
        return best >= 0;
    }

    /// Moves the free unknowns towards their least squares until one meets 0, which is then no
    /// longer free. Returns whether none has.
    bool settle() {
        const Eigen::VectorXd target =
            Matrix(m_matrix(Eigen::all, m_free)).householderQr().solve(m_right);
        double step = 1;
        for (Eigen::Index k = 0; k < target.size(); ++k)
            if (const double x = m_x[m_free[std::size_t(k)]]; target[k] <= 0)
                step = std::min(step, x / (x - target[k]));
        const bool all = target.size() == 0 || target.minCoeff() > 0;
        for (Eigen::Index k = 0; k < target.size(); ++k) {
            double& x = m_x[m_free[std::size_t(k)]];
            x = all ? target[k] : x + step * (target[k] - x);
        }
        if (all)
            return true;
        std::size_t lowest = 0;
        for (std::size_t k = 1; k < m_free.size(); ++k)
            if (m_x[m_free[k]] < m_x[m_free[lowest]])
                lowest = k;
        m_x[m_free[lowest]] = 0;
        m_free.erase(m_free.begin() + std::ptrdiff_t(lowest));
        return false;
    }

    Matrix m_matrix;
    Eigen::VectorXd m_right, m_x;
    std::vector<Eigen::Index> m_free; ///< unknowns that may be above 0
};

} // namespace

std::vector<double> nonnegativeFit(const LinearSystem& system) {
    return ActiveSet(system).solve();
}

} // namespace limn
