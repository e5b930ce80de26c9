// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/residual_density.h"

#include "engine/core/parallel.h"
#include "engine/final_lightmap/chart_pieces.h"
#include "engine/final_lightmap/fit_input.h"
#include "engine/picture/gather_tile.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace limn {

namespace {

/// Errors are relative to the light of their chart, or to this part of the mean light where that is
/// more; those below kFloor are taken to be as large. So a bright place that nobody may see takes
/// no texels from a dim one.
constexpr double kDim = 0.5, kFloor = 0.01;
/// A trial has this part of the texels: its residual is larger and found faster.
constexpr std::uint32_t kTrial = 2;
/// Range of a chart's factor, relative to that before. The light that is known here is that of a
/// bake, not the final one, so whole charts change less than pieces, which a bake does not have.
constexpr double kMinChange = 0.7, kMaxChange = 2, kMinPiece = 0.25, kMaxPiece = 16;
constexpr int kTrials = 2, kCutTrials = 3;

/// The samples of an instance's charts before any is cut.
using ChartSamples = std::vector<std::vector<ResidualSample>>;

struct Trial {
    std::vector<ChartSamples> samples; ///< per instance
    double light = 0;                  ///< mean
    double texels = 0;                 ///< their number
    double texelsPerMetre = 0;         ///< of a factor of 1, in the final lightmap
};

glm::vec2 chartUvOf(const MeshCharts& charts, const MeshPoint& p) {
    const auto corner = [&](std::size_t k) {
        return charts.chartUv[charts.indices[3 * std::size_t(p.triangle) + k]];
    };
    const glm::vec2 b = p.barycentric;
    return corner(0) * (1 - b.x - b.y) + corner(1) * b.x + corner(2) * b.y;
}

struct DensityFinder {
    const Scene& scene;
    const std::vector<MeshCharts>& charts;
    const LitTexelCount& count;
    const LightOfPoint& light;
    const Progress& progress;
    ChartFactors before; ///< of `charts`
    CutDensity found;

    const MeshCharts& chartsOf(std::uint32_t instance) const {
        return charts[scene.instances[instance].mesh];
    }
    Trial tryTexels() const;
    void adapt(Trial& trial, bool cutCharts);
};

/// Fits a lightmap to the light, and finds what is left of it.
Trial DensityFinder::tryTexels() const {
    const CutScene& cut = found.cut;
    LitTexelCount fewer = count;
    fewer.texels = std::max(count.texels / kTrial, 1U);
    const LitTexels lit = layLitTexels(cut, found.factors, fewer, progress);
    const std::vector<FittedPoint> points = fittedPoints(lit);
    const TexelFitInput input = fitInput(cut.scene, lit, points);
    std::vector<glm::vec3> wanted(points.size());
    parallelRanges(points.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p)
            wanted[p] = light(hitOf(scene, cut, lit, points[p]));
    });
    const std::vector<glm::vec3> texels =
        TexelFit(input).solve(wanted, meanOfTexels(lit, points, wanted));
    Trial trial;
    trial.texelsPerMetre = double(lit.atlas.texelsPerMetre) * std::sqrt(double(kTrial));
    trial.texels = double(lit.atlas.texels.size());
    trial.samples.resize(scene.instances.size());
    for (std::uint32_t i = 0; i < trial.samples.size(); ++i)
        trial.samples[i].resize(chartsOf(i).chartSize.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
        const AtlasTexel& texel = lit.atlas.texels[points[p].texel];
        const TexelLookup& lookup = input.points[p];
        glm::vec3 shown(0);
        for (std::size_t k = 0; k < 4; ++k)
            shown += lookup.weight[k] * texels[lookup.texel[k]];
        const MeshPoint& point = texel.points[points[p].point];
        const MeshCharts& cutCharts = cut.charts[cut.scene.instances[texel.instance].mesh];
        const float factor =
            found.factors[texel.instance][cutCharts.chartOfTriangle[point.triangle]];
        const MeshPoint source = cut.toSource(texel.instance, point);
        const MeshCharts& whole = chartsOf(texel.instance);
        const auto error = float(greyOf(shown - wanted[p]));
        const float grey = float(greyOf(wanted[p])), squaredFactor = factor * factor;
        trial.light += double(grey);
        trial.samples[texel.instance][whole.chartOfTriangle[source.triangle]].push_back(
            {.uv = chartUvOf(whole, source),
             .area = 1 / (squaredFactor * float(texel.count)),
             .light = grey,
             .squared = error * error * squaredFactor,
             .floor = float(kFloor * kFloor) * squaredFactor});
    }
    if (!points.empty())
        trial.light /= double(points.size());
    return trial;
}

/// Factors in steps, so that small charts of nearly the same may share texels.
float stepped(double factor) {
    constexpr double kSteps = 2; // per octave
    return float(std::exp2(std::round(std::log2(factor) * kSteps) / kSteps));
}

/// Chooses pieces and factors by what a trial has left.
void DensityFinder::adapt(Trial& trial, bool cutCharts) {
    const double dim = kDim * trial.light;
    double texels = 0; // with factors of the fourth root of squared error
    for (std::uint32_t i = 0; i < trial.samples.size(); ++i)
        for (const std::vector<ResidualSample>& samples : trial.samples[i]) {
            ResidualSums sums;
            for (const ResidualSample& s : samples)
                sums.add(s);
            texels += sums.area * std::sqrt(sums.relative(dim));
        }
    if (!(texels > 0))
        return;
    const double scale = std::sqrt(trial.texels / texels);
    SceneCuts cuts(trial.samples.size());
    std::vector<std::vector<std::vector<float>>> pieceFactors(trial.samples.size());
    parallelRanges(trial.samples.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const MeshCharts& whole = chartsOf(std::uint32_t(i));
            const double perUnit = trial.texelsPerMetre * double(atlasScale(scene.instances[i]));
            cuts[i].resize(whole.chartSize.size());
            pieceFactors[i].resize(whole.chartSize.size());
            for (std::size_t c = 0; c < whole.chartSize.size(); ++c) {
                const double start = before[i].empty() ? 1 : double(before[i][c]);
                const double low = cutCharts ? kMinPiece : kMinChange,
                             high = cutCharts ? kMaxPiece : kMaxChange;
                const auto factorOf = [&](double squared) {
                    return std::clamp(scale * std::sqrt(std::sqrt(squared)), low * start,
                                      high * start);
                };
                std::vector<ResidualSample>& samples = trial.samples[i][c];
                std::vector<ResidualSums> pieces(1);
                if (cutCharts)
                    pieces = cutIntoPieces(
                        samples, whole.chartSize[c], dim,
                        [&](double squared) { return perUnit * factorOf(squared); }, cuts[i][c]);
                else
                    for (const ResidualSample& s : samples)
                        pieces[0].add(s);
                for (const ResidualSums& sums : pieces)
                    pieceFactors[i][c].push_back(
                        sums.area > 0 ? stepped(factorOf(sums.relative(dim))) : float(start));
            }
        }
    });
    if (cutCharts)
        found.cut = cutScene(scene, charts, cuts);
    for (std::uint32_t i = 0; i < found.factors.size(); ++i) {
        const std::size_t parts =
            found.cut.charts[found.cut.scene.instances[i].mesh].chartSize.size();
        found.factors[i].resize(parts);
        for (std::uint32_t c = 0; c < parts; ++c) {
            const CutSource::Chart source = found.cut.chartBefore(i, c);
            found.factors[i][c] = pieceFactors[i][source.chart][source.piece];
        }
    }
}

} // namespace

CutDensity densityByResidual(const Scene& scene, const std::vector<MeshCharts>& charts,
                             ChartFactors factors, const LitTexelCount& count, bool cutCharts,
                             const LightOfPoint& light, const Progress& progress) {
    factors.resize(scene.instances.size());
    DensityFinder finder{
        scene, charts, count, light, progress, factors, {cutScene(scene, charts, {}), factors}};
    for (std::size_t i = 0; i < factors.size(); ++i)
        if (factors[i].empty())
            finder.found.factors[i].assign(charts[scene.instances[i].mesh].chartSize.size(), 1);
    const int trials = cutCharts ? kCutTrials : kTrials;
    for (int k = 0; k < trials && !progress.cancelled(); ++k) {
        Trial trial = finder.tryTexels();
        finder.adapt(trial, cutCharts);
    }
    return std::move(finder.found);
}

} // namespace limn
