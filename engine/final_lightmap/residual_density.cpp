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
/// Range of a chart's factor, relative to that before. The light that is known here is that of a
/// bake, which has next to no detail on small charts. Those that are large enough to be cut have
/// it.
constexpr double kMinChange = 0.7, kMaxChange = 2, kMinPiece = 0.7, kMaxPiece = 16;
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

/// Factors in steps, so that small charts of nearly the same may share texels. Those in different
/// parts of a chart, with a wall between, must not share any, and differ by little.
float stepped(double factor, std::uint32_t part) {
    constexpr double kSteps = 2; // per octave
    constexpr std::uint32_t kParts = 16;
    constexpr double kNextPart = 1. / 512; // octaves
    return float(std::exp2(std::round(std::log2(factor) * kSteps) / kSteps +
                           kNextPart * double(part % kParts)));
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
                const auto factorOf = [&](double squared) {
                    return std::clamp(scale * std::sqrt(std::sqrt(squared)), kMinPiece * start,
                                      kMaxPiece * start);
                };
                std::vector<ResidualSample>& samples = trial.samples[i][c];
                std::vector<ResidualSums> pieces(1);
                if (cutCharts)
                    pieces = cutIntoPieces(samples, crossings[i][c], dim, {perUnit, factorOf},
                                           cuts[i][c]);
                else
                    for (const ResidualSample& s : samples)
                        pieces[0].add(s);
                for (const ResidualSums& sums : pieces) {
                    double factor = sums.area > 0 ? factorOf(sums.relativeInRectangle(dim)) : start;
                    if (pieces.size() == 1)
                        factor = std::clamp(factor, kMinChange * start, kMaxChange * start);
                    pieceFactors[i][c].push_back(stepped(factor, sums.part));
                }
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
