// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/residual_density.h"

#include "engine/core/parallel.h"
#include "engine/final_lightmap/chart_crossings.h"
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
/// Range of factors, relative to those of the bake. Fewer texels gather too few rays: a piece of a
/// wall would have one error all over. Small charts have next to no detail in a bake, so charts
/// that are not cut, among them all small ones, gain less.
constexpr double kMinChange = 0.7, kMaxChange = 2, kMaxPiece = 16;
constexpr int kTrials = 2, kCutTrials = 3;

/// The samples of an instance's charts before any is cut.
using ChartSamples = std::vector<std::vector<ResidualSample>>;

struct Trial {
    std::vector<ChartSamples> samples; ///< per instance
    double light = 0;                  ///< mean
    double texels = 0;                 ///< their number
    double texelsPerMetre = 0;         ///< of a factor of 1, in the final lightmap
};

struct DensityFinder {
    const TraceScene& trace;
    const Scene& scene; ///< of it
    const std::vector<MeshCharts>& charts;
    const LitTexelCount& count;
    const LightOfPoint& light;
    const Progress& progress;
    ChartFactors before; ///< of `charts`
    CutDensity found;
    ChartCrossings crossings = {}; ///< that the trials have found

    const MeshCharts& chartsOf(std::uint32_t instance) const {
        return charts[scene.instances[instance].mesh];
    }
    Trial tryTexels(bool cutCharts);
    void addCrossings(const LitTexels& lit);
    void adapt(Trial& trial, bool cutCharts);
    std::vector<float> factorsOfPieces(std::uint32_t instance, std::uint32_t chart, Trial& trial,
                                       double scale, ChartCuts* cuts) const;
};

/// Adds what crosses charts between the texels of a trial.
void DensityFinder::addCrossings(const LitTexels& lit) {
    ChartCrossings more = findCrossings(trace, charts, found.cut, lit, progress);
    crossings.resize(more.size());
    for (std::size_t i = 0; i < more.size(); ++i) {
        crossings[i].resize(more[i].size());
        for (std::size_t c = 0; c < more[i].size(); ++c)
            crossings[i][c].insert(crossings[i][c].end(), more[i][c].begin(), more[i][c].end());
    }
}

/// Fits a lightmap to the light, and finds what is left of it.
Trial DensityFinder::tryTexels(bool cutCharts) {
    const CutScene& cut = found.cut;
    LitTexelCount fewer = count;
    fewer.texels = std::max(count.texels / kTrial, 1U);
    const LitTexels lit = layLitTexels(cut, found.factors, fewer, progress);
    if (cutCharts)
        addCrossings(lit);
    const std::vector<FittedPoint> points = fittedPoints(lit);
    const TexelFitInput input = fitInput(cut.scene, lit, points);
    std::vector<float> wanted(points.size()); // greys
    parallelRanges(points.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p)
            wanted[p] = float(greyOf(light(hitOf(scene, cut, lit, points[p]))));
    });
    const std::vector<float> texels =
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
        float shown = 0;
        for (std::size_t k = 0; k < 4; ++k)
            shown += lookup.weight[k] * texels[lookup.texel[k]];
        const MeshPoint& point = texel.points[points[p].point];
        const MeshCharts& cutMesh = cut.charts[cut.scene.instances[texel.instance].mesh];
        const float factor = found.factors[texel.instance][cutMesh.chartOfTriangle[point.triangle]];
        const MeshPoint source = cut.toSource(texel.instance, point);
        const MeshCharts& whole = chartsOf(texel.instance);
        const float error = shown - wanted[p], squaredFactor = factor * factor;
        trial.light += double(wanted[p]);
        trial.samples[texel.instance][whole.chartOfTriangle[source.triangle]].push_back(
            {.uv = chartUvAt(whole, source),
             .width = texel.width / atlasScale(scene.instances[texel.instance]),
             .area = 1 / (squaredFactor * float(texel.count)),
             .light = wanted[p],
             .squared = error * error * squaredFactor,
             .floor = float(kFloor * kFloor) * squaredFactor});
    }
    if (!points.empty())
        trial.light /= double(points.size());
    return trial;
}

/// Rounds a factor, so that small charts with similar ones get the same and may share texels. Parts
/// of a chart with a wall between must share none, so their factors are made to differ a little.
float stepped(double factor, std::uint32_t part) {
    constexpr double kSteps = 2; // per octave
    constexpr std::uint32_t kParts = 16;
    constexpr double kNextPart = 1. / 512; // octaves
    return float(std::exp2(std::round(std::log2(factor) * kSteps) / kSteps +
                           kNextPart * double(part % kParts)));
}

/// The factor of each piece of a chart. Cuts it where `cuts` is not null.
std::vector<float> DensityFinder::factorsOfPieces(std::uint32_t i, std::uint32_t c, Trial& trial,
                                                  double scale, ChartCuts* cuts) const {
    const double dim = kDim * trial.light, start = before[i].empty() ? 1 : double(before[i][c]);
    const auto factorOf = [&](double squared) {
        return std::clamp(scale * std::sqrt(std::sqrt(squared)), kMinChange * start,
                          kMaxPiece * start);
    };
    std::vector<ResidualSample>& samples = trial.samples[i][c];
    std::vector<ResidualSums> pieces;
    if (cuts) {
        const double perUnit = trial.texelsPerMetre * double(atlasScale(scene.instances[i]));
        pieces = cutIntoPieces(samples, crossings[i][c], dim, {perUnit, factorOf}, *cuts);
    } else {
        pieces = {sumOf(samples)};
    }
    const double highest = (pieces.size() == 1 ? kMaxChange : kMaxPiece) * start;
    std::vector<float> factors;
    for (const ResidualSums& sums : pieces) {
        const double factor = sums.area > 0 ? factorOf(sums.relativeInRectangle(dim)) : start;
        factors.push_back(stepped(std::min(factor, highest), sums.part));
    }
    return factors;
}

/// Chooses pieces and factors by what a trial has left.
void DensityFinder::adapt(Trial& trial, bool cutCharts) {
    double texels = 0; // with factors of the fourth root of squared error
    for (const ChartSamples& ofInstance : trial.samples)
        for (const std::vector<ResidualSample>& samples : ofInstance) {
            const ResidualSums sums = sumOf(samples);
            texels += sums.area * std::sqrt(sums.relative(kDim * trial.light));
        }
    if (!(texels > 0))
        return;
    const double scale = std::sqrt(trial.texels / texels);
    SceneCuts cuts(trial.samples.size());
    std::vector<std::vector<std::vector<float>>> pieceFactors(trial.samples.size());
    parallelRanges(trial.samples.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            cuts[i].resize(trial.samples[i].size());
            for (std::uint32_t c = 0; c < cuts[i].size(); ++c)
                pieceFactors[i].push_back(factorsOfPieces(std::uint32_t(i), c, trial, scale,
                                                          cutCharts ? &cuts[i][c] : nullptr));
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

CutDensity densityByResidual(const TraceScene& trace, const std::vector<MeshCharts>& charts,
                             ChartFactors factors, const LitTexelCount& count, bool cutCharts,
                             const LightOfPoint& light, const Progress& progress) {
    const Scene& scene = trace.scene();
    factors.resize(scene.instances.size());
    DensityFinder finder{trace, scene,    charts,  count,
                         light, progress, factors, {cutScene(scene, charts, {}), factors}};
    for (std::size_t i = 0; i < factors.size(); ++i)
        if (factors[i].empty())
            finder.found.factors[i].assign(charts[scene.instances[i].mesh].chartSize.size(), 1);
    const int trials = cutCharts ? kCutTrials : kTrials;
    for (int k = 0; k < trials && !progress.cancelled(); ++k) {
        Trial trial = finder.tryTexels(cutCharts);
        finder.adapt(trial, cutCharts);
    }
    return std::move(finder.found);
}

} // namespace limn
