// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/fit_texels.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

namespace limn {

/// Weight of a neighbour's difference, beside that of a texel's own points, which is about 1.
static constexpr double kSmoothness = 0.01;
/// Weight of a seam of one texel's length.
static constexpr double kSeam = 4;
static constexpr double kTolerance = 1e-4;
static constexpr int kMaxSteps = 200;

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

struct TexelFit::System {
    Matrix rows;
    std::vector<double> pointScale; ///< square roots of the points' weights
    std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours;
};

namespace {

/// Fills a sparse matrix row by row. This needs no memory besides that of the matrix.
struct RowWriter {
    Matrix& rows;
    int row = 0;
    std::array<std::pair<std::uint32_t, double>, 8> entries{};
    std::size_t count = 0;

    void add(std::uint32_t texel, double value) {
        for (std::size_t k = 0; k < count; ++k)
            if (entries[k].first == texel) {
                entries[k].second += value;
                return;
            }
        entries[count++] = {texel, value};
    }
    void add(const TexelLookup& lookup, double scale) {
        for (std::size_t k = 0; k < 4; ++k)
            if (lookup.weight[k] != 0)
                add(lookup.texel[k], scale * double(lookup.weight[k]));
    }
    void endRow() {
        std::sort(entries.begin(), entries.begin() + std::ptrdiff_t(count));
        rows.startVec(row);
        for (std::size_t k = 0; k < count; ++k)
            rows.insertBack(row, int(entries[k].first)) = entries[k].second;
        ++row;
        count = 0;
    }
};

} // namespace

TexelFit::TexelFit(const TexelFitInput& input) : m_system(std::make_unique<System>()) {
    System& s = *m_system;
    const std::size_t rows = input.points.size() + input.neighbours.size() + input.seams.size();
    s.rows.resize(Eigen::Index(rows), Eigen::Index(input.texels));
    s.rows.reserve(Eigen::Index(4 * input.points.size() + 2 * input.neighbours.size() +
                                8 * input.seams.size()));
    RowWriter writer{s.rows};
    s.pointScale.reserve(input.points.size());
    for (std::size_t p = 0; p < input.points.size(); ++p) {
        s.pointScale.push_back(std::sqrt(double(input.weights[p])));
        writer.add(input.points[p], s.pointScale.back());
        writer.endRow();
    }
    s.neighbours = input.neighbours;
    for (const auto& [a, b] : s.neighbours) {
        writer.add(a, std::sqrt(kSmoothness));
        writer.add(b, -std::sqrt(kSmoothness));
        writer.endRow();
    }
    for (const SeamLookup& seam : input.seams) {
        const double scale = std::sqrt(kSeam * double(seam.length));
        writer.add(seam.first, scale);
        writer.add(seam.second, -scale);
        writer.endRow();
    }
    s.rows.finalize();
}

TexelFit::~TexelFit() = default;

std::vector<float> TexelFit::solve(const std::vector<float>& light,
                                   const std::vector<float>& first) const {
    const System& s = *m_system;
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(s.rows.rows());
    for (std::size_t p = 0; p < light.size(); ++p)
        wanted[Eigen::Index(p)] = s.pointScale[p] * double(light[p]);
    for (std::size_t k = 0; k < s.neighbours.size(); ++k) {
        const auto [a, b] = s.neighbours[k];
        wanted[Eigen::Index(light.size() + k)] =
            std::sqrt(kSmoothness) * (double(first[a]) - double(first[b]));
    }
    Eigen::VectorXd start(Eigen::Index(first.size()));
    for (std::size_t t = 0; t < first.size(); ++t)
        start[Eigen::Index(t)] = double(first[t]);
    Eigen::LeastSquaresConjugateGradient<Matrix> solver; // it counts its steps
    solver.setTolerance(kTolerance);
    solver.setMaxIterations(kMaxSteps);
    solver.compute(s.rows);
    const Eigen::VectorXd solution = solver.solveWithGuess(wanted, start);
    std::vector<float> fitted(first.size());
    for (std::size_t t = 0; t < first.size(); ++t)
        fitted[t] = float(solution[Eigen::Index(t)]);
    return fitted;
}

std::vector<glm::vec3> TexelFit::solve(const std::vector<glm::vec3>& light,
                                       const std::vector<glm::vec3>& first) const {
    const auto channel = [](const std::vector<glm::vec3>& colours, int c) {
        std::vector<float> values;
        values.reserve(colours.size());
        for (const glm::vec3 colour : colours)
            values.push_back(colour[c]);
        return values;
    };
    std::array<std::vector<float>, 3> fitted;
    parallelRanges(3, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            fitted[c] = solve(channel(light, int(c)), channel(first, int(c)));
    });
    std::vector<glm::vec3> colours(first.size());
    for (std::size_t t = 0; t < first.size(); ++t)
        colours[t] = {fitted[0][t], fitted[1][t], fitted[2][t]};
    return colours;
}

} // namespace limn
