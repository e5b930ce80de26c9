// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/residual_density.h"

#include "engine/core/parallel.h"
#include "engine/final_lightmap/fit_input.h"
#include "engine/picture/gather_tile.h"

#include <algorithm>
#include <cmath>

namespace limn {

namespace {

/// Errors are relative to the light of their chart, or to this part of the mean light where that is
/// more; those below kFloor are taken to be as large. So a bright place that nobody may see takes
/// no texels from a dim one.
constexpr double kDim = 0.5, kFloor = 0.01;
/// A trial has this part of the texels: its residual is larger and found faster.
constexpr std::uint32_t kTrial = 2;
constexpr double kMinChange = 0.7, kMaxChange = 2;
constexpr int kTrials = 2;

/// Sums over the points of a chart, of greys.
struct ChartResidual {
    double squared = 0; ///< of squared errors
    double light = 0, points = 0;
};
using Residuals = std::vector<std::vector<ChartResidual>>;

/// Fits a lightmap to the light, and sums what is left of it. Returns the mean light.
double addResiduals(const Scene& scene, const LitTexels& lit, const LightOfPoint& light,
                    Residuals& residuals) {
    const std::vector<FittedPoint> points = fittedPoints(lit);
    const TexelFitInput input = fitInput(scene, lit, points);
    std::vector<glm::vec3> wanted(points.size());
    parallelRanges(points.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p)
            wanted[p] = light(hitOf(scene, lit, points[p]));
    });
    const std::vector<glm::vec3> texels =
        TexelFit(input).solve(wanted, meanOfTexels(lit, points, wanted));
    double sum = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const AtlasTexel& texel = lit.atlas.texels[points[p].texel];
        const TexelLookup& lookup = input.points[p];
        glm::vec3 shown(0);
        for (std::size_t k = 0; k < 4; ++k)
            shown += lookup.weight[k] * texels[lookup.texel[k]];
        const std::uint32_t mesh = scene.instances[texel.instance].mesh;
        const std::uint32_t chart =
            lit.atlas.layout.meshes[mesh].chartOfTriangle[texel.points[points[p].point].triangle];
        const double error = greyOf(shown - wanted[p]);
        ChartResidual& residual = residuals[texel.instance][chart];
        residual.squared += error * error;
        residual.light += greyOf(wanted[p]);
        ++residual.points;
        sum += greyOf(wanted[p]);
    }
    return points.empty() ? 0 : sum / double(points.size());
}

} // namespace

ChartFactors factorsByResidual(const Scene& scene, const std::vector<MeshCharts>& charts,
                               ChartFactors factors, const LitTexelCount& count,
                               const LightOfPoint& light, const Progress& progress) {
    factors.resize(scene.instances.size());
    for (std::size_t i = 0; i < factors.size(); ++i)
        if (factors[i].empty())
            factors[i].assign(charts[scene.instances[i].mesh].chartSize.size(), 1);
    const ChartFactors before = factors;
    LitTexelCount trial = count;
    trial.texels = std::max(count.texels / kTrial, 1U);
    for (int k = 0; k < kTrials && !progress.cancelled(); ++k) {
        const LitTexels lit = layLitTexels(scene, charts, factors, trial, progress);
        Residuals residuals(factors.size());
        for (std::size_t i = 0; i < factors.size(); ++i)
            residuals[i].resize(factors[i].size());
        const double dim = kDim * addResiduals(scene, lit, light, residuals);
        if (!(dim > 0))
            return before;
        // The fourth root of squared error over texels, and its mean over all texels.
        const auto need = [&](std::size_t i, std::size_t c) {
            const ChartResidual& r = residuals[i][c];
            const double mean = r.light / r.points;
            const double squared =
                r.squared / r.points / (mean * mean + dim * dim) + kFloor * kFloor;
            return std::sqrt(std::sqrt(squared)) / std::sqrt(double(factors[i][c]));
        };
        double sum = 0, points = 0;
        for (std::size_t i = 0; i < factors.size(); ++i)
            for (std::size_t c = 0; c < factors[i].size(); ++c)
                if (const double n = residuals[i][c].points; n > 0) {
                    sum += n * need(i, c);
                    points += n;
                }
        for (std::size_t i = 0; i < factors.size(); ++i)
            for (std::size_t c = 0; c < factors[i].size(); ++c)
                if (residuals[i][c].points > 0) {
                    const double wanted = double(factors[i][c]) * need(i, c) / (sum / points);
                    factors[i][c] = float(std::clamp(wanted, kMinChange * double(before[i][c]),
                                                     kMaxChange * double(before[i][c])));
                }
    }
    return factors;
}

} // namespace limn
