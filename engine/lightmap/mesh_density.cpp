// SPDX-License-Identifier: MIT
#include "engine/lightmap/mesh_density.h"

#include <cmath>
#include <cstddef>
#include <numeric>

namespace limn {

namespace {

double sumOf(std::span<const float> values) {
    double sum = 0;
    for (const float v : values)
        sum += double(v);
    return sum;
}

/// Hits per area of a part of a surface, blended towards `before`, the density of the larger part
/// that contains it, as if kHits more had been found at that density.
double drawn(double weight, double area, double perHit, double before) {
    constexpr double kHits = 8;
    return (weight + kHits * perHit) / (area + kHits * perHit / before);
}

/// Level at which cells have enough hits to estimate a density of their own.
std::uint8_t levelFor(std::size_t hits) {
    constexpr double kHitsPerCell = 16;
    const double level = std::log2(std::max(double(hits) / kHitsPerCell, 1.0)) / 2;
    return std::uint8_t(std::min(level, double(MeshDensity::kMaxLevel)));
}

/// Densities of the cells of one mesh in hits per square metre of its instances.
MeshDensity cellDensities(const Mesh& mesh, const MeshCharts& charts, const MeshChartShapes& shapes,
                          const MeshHits& hits, double perHit, double all) {
    const std::size_t triangles = mesh.triangleCount();
    const double inObject = std::accumulate(shapes.area.begin(), shapes.area.end(), 0.);
    if (!(hits.area > 0 && inObject > 0))
        return {};
    const double toWorld = hits.area / inObject; // of all instances
    const double ofMesh = std::max(drawn(sumOf(hits.weight), hits.area, perHit, all), all / 2);
    MeshDensity result;
    std::vector<std::size_t> count(triangles);
    std::vector<double> chartSum(charts.chartSize.size());
    for (std::size_t i = 0; i < hits.points.size(); ++i) {
        ++count[hits.points[i].triangle];
        chartSum[charts.chartOfTriangle[hits.points[i].triangle]] += double(hits.weight[i]);
    }
    std::uint32_t cells = 0;
    for (std::size_t t = 0; t < triangles; ++t) {
        result.level.push_back(levelFor(count[t]));
        result.begin.push_back(cells);
        cells += 1U << 2 * result.level.back();
    }
    result.density.assign(cells, 0);
    for (std::size_t i = 0; i < hits.points.size(); ++i) {
        const MeshPoint& p = hits.points[i];
        result.density[result.cell(p.triangle, result.cellAt(p.triangle, p.barycentric))] +=
            hits.weight[i];
    }
    for (std::uint32_t t = 0; t < triangles; ++t) {
        const std::uint32_t c = charts.chartOfTriangle[t];
        const double ofChart = drawn(chartSum[c], shapes.area[c] * toWorld, perHit, ofMesh);
        const double area = double(triangleArea(mesh, t)) * toWorld;
        forCells(result.side(t), [&](glm::uvec2 cell) {
            float& d = result.density[result.cell(t, cell)];
            d = float(std::max(drawn(double(d), area * result.share(t, cell), perHit, ofChart),
                               ofMesh / 2));
        });
    }
    return result;
}

/// Stores a single value if all cells agree.
void simplify(MeshDensity& d) {
    const float first = d.density.front();
    for (std::uint32_t t = 0; t < d.level.size(); ++t) {
        bool same = true;
        forCells(d.side(t),
                 [&](glm::uvec2 cell) { same = same && d.density[d.cell(t, cell)] == first; });
        if (!same)
            return;
    }
    d = {{}, {}, {first}};
}

/// Rounds the centre, so that small changes leave it unchanged.
double rounded(double centre) {
    return std::exp2(std::round(2 * std::log2(centre)) / 2);
}

/// Power of sixteen of densityClass(), at most 1; below 1/16 a power of four, because a ground that
/// reaches to the horizon has so much area that rounding up to the next power of sixteen would take
/// most surfels from the house on it.
float surfelClass(double value, double centre) {
    constexpr int kMinimum = -10;
    const int sixteens = densityClass(value, centre);
    const double fours = std::round(std::log2(value / rounded(centre)) / 2);
    return float(sixteens >= -1 ? std::exp2(4 * std::min(sixteens, 0))
                                : std::exp2(2 * std::clamp(fours, double(kMinimum), -2.)));
}

} // namespace

DensityClassBounds densityClassBounds(double centre) {
    constexpr double kUp = 0.5, kDown = 0.1;
    const double middle = rounded(centre);
    DensityClassBounds result;
    for (int k = kMinDensityClass + 1; k <= kMaxDensityClass; ++k)
        result[std::size_t(k - kMinDensityClass - 1)] =
            middle * std::exp2(4 * (k > 0 ? k - kUp : k - 1 + kDown));
    return result;
}

int densityClass(double value, double centre) {
    return densityClass(value, densityClassBounds(centre));
}

std::vector<MeshDensity> surfelDensities(const Scene& scene, std::span<const MeshCharts> charts,
                                         std::span<const MeshChartShapes> shapes,
                                         std::span<const MeshHits> hits) {
    std::vector<MeshDensity> result(hits.size());
    double sum = 0, count = 0, area = 0, squares = 0;
    for (const MeshHits& h : hits) {
        sum += sumOf(h.weight);
        count += double(h.weight.size());
        area += h.area;
    }
    if (!(sum > 0 && area > 0))
        return result;
    for (std::size_t m = 0; m < hits.size(); ++m) {
        result[m] = cellDensities(scene.assets->meshes[m], charts[m], shapes[m], hits[m],
                                  sum / count, sum / area);
        for (std::size_t i = 0; i < hits[m].points.size(); ++i) {
            const MeshPoint& p = hits[m].points[i];
            squares += double(hits[m].weight[i]) * double(result[m].at(p.triangle, p.barycentric));
        }
    }
    for (MeshDensity& d : result) {
        for (float& x : d.density)
            x = surfelClass(double(x), squares / sum);
        simplify(d);
    }
    return result;
}

} // namespace limn
