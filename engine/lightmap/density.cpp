// SPDX-License-Identifier: MIT
#include "engine/lightmap/density.h"

#include "engine/core/large_pages.h"
#include "engine/core/parallel.h"
#include "engine/lightmap/chart_places.h"
#include "engine/lightmap/texel_points.h"
#include "engine/math/sampling.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr double kTexelsPerProbe = 4, kMaxProbes = 8192;
constexpr double kRaysPerTexel = 16, kMaxRays = double(1 << 19); ///< of all probes together
/// Smaller distances than this many texels are clamped: no texel resolves the light there.
constexpr double kAlike = 8;
/// Charts that need less than this share of all texels have the density of their instance.
constexpr double kOwnDensity = 0.01;
/// Charts that would waste this share of all texels on parts that see nothing nearby are varied.
constexpr double kWaste = 0.1;
/// A part of a chart is near if it needs at least 4 to this power times the texels per metre of
/// most of the chart.
constexpr int kFar = 2;

/// A chart of an instance.
struct Chart {
    std::uint32_t instance, chart;
    double area;                      ///< of one side in the world [m^2]
    std::uint32_t sides;              ///< that are lit
    std::uint32_t begin = 0, end = 0; ///< its probes; none: too small for one of its own
    double detail = 0;                ///< texels per area that it deserves, relative
    int fours = 0;                    ///< its texels per metre are multiplied by 4^fours
    int usual = 0;                    ///< the class that most of its probes deserve
    int even = 0;                     ///< the class that it deserves as a whole
    bool varied = false;              ///< parts of it deserve far more
};

/// A point on one side of a surface.
struct Probe {
    MeshPoint point;
    std::uint32_t instance, back, seed;
    bool inSolid = false; ///< most rays meet backs
};

/// Hit of a probe's ray.
struct Met {
    std::uint32_t instance = ~0U; ///< ~0: nothing that sends light
    MeshPoint point{};
    std::uint32_t back = 0;
    float perMetre = 0; ///< 1 / distance; 0 for the sky [1/m]
};

class DensityFinder {
public:
    DensityFinder(const TraceScene& trace, const std::vector<MeshCharts>& charts,
                  std::uint32_t texels)
        : m_trace(trace), m_scene(trace.scene()), m_in(atlasInput(trace.scene(), charts)),
          m_texels(texels) {}

    BakeDensity run(const Progress& progress);

private:
    void listCharts();
    void addProbes();
    void addProbes(Chart& chart, std::uint32_t count);
    void look(Probe& probe, Met* met) const;
    double nearness(std::uint32_t probe, float nearest) const;
    void findDetail(float nearest);
    int classAt(double nearness) const { return densityClass(nearness, m_classes); }
    template <class Visit>
    void forArrived(const Visit& visit) const;
    int usualClass(const Chart& chart) const;
    std::vector<double> nearWorth() const;
    std::vector<VariedChart> varied() const;
    double chooseChart(Chart& chart, double near);
    void chooseDensities();
    std::vector<std::vector<float>> factors() const;
    std::vector<MeshHits> hits() const;

    const TraceScene& m_trace;
    const Scene& m_scene;
    AtlasInput m_in;
    std::uint32_t m_texels;
    std::vector<Chart> m_all;           ///< by instance
    std::vector<std::uint32_t> m_first; ///< per instance: of m_all; ~0: none
    double m_area = 0;                  ///< [m^2], of all sides
    double m_worth = 0; ///< of all texels: their number times the area of those with fours 0 [m^2]
    double m_size = 0;  ///< [m], the root of that
    std::vector<Probe> m_probes;
    std::uint32_t m_rays = 0; ///< per probe
    std::vector<Met> m_met;
    DensityClassBounds m_classes = densityClassBounds(1); ///< in terms of nearness
    BakeDensity m_result;
};

/// Computes areas with the scale that the atlas uses, which rotations of an object do not change.
void DensityFinder::listCharts() {
    m_first.assign(m_scene.instances.size(), ~0U);
    for (std::uint32_t i = 0; i < m_scene.instances.size(); ++i) {
        const Instance& instance = m_scene.instances[i];
        if (!hasLightmap(m_in, instance))
            continue;
        m_first[i] = std::uint32_t(m_all.size());
        const std::vector<double>& area = m_in.shapes[instance.mesh].area;
        const double scale = double(m_in.scale[i]);
        for (std::uint32_t c = 0; c < area.size(); ++c) {
            m_all.push_back({i, c, area[c] * scale * scale, sidesOf(m_in, instance)});
            m_area += m_all.back().area * m_all.back().sides;
        }
    }
    m_size = std::sqrt(m_area);
}

/// Distributes probes in proportion to the square root of each chart's area. The remainder of
/// charts without a probe carries over to the next chart of the instance; each instance has at
/// least one.
void DensityFinder::addProbes() {
    const double probes = std::min(m_texels / kTexelsPerProbe, kMaxProbes);
    double roots = 0, carried = 0;
    for (const Chart& c : m_all)
        roots += std::sqrt(c.area) * c.sides;
    for (std::size_t i = 0; i < m_all.size() && roots > 0; ++i) {
        if (i == 0 || m_all[i].instance != m_all[i - 1].instance)
            carried = 1;
        carried += std::sqrt(m_all[i].area) * probes / roots;
        const double count = m_all[i].area > 0 ? std::floor(carried) : 0;
        carried -= count;
        addProbes(m_all[i], std::uint32_t(count));
    }
}

/// Point k of n lies in the triangle at (k + 1/2) / n of the chart's cumulative area.
void DensityFinder::addProbes(Chart& chart, std::uint32_t count) {
    const Instance& instance = m_scene.instances[chart.instance];
    const Mesh& mesh = m_scene.meshOf(instance);
    const auto triangles = m_in.shapes[instance.mesh].trianglesOf(chart.chart);
    const double area = m_in.shapes[instance.mesh].area[chart.chart];
    double passed = 0;
    chart.begin = std::uint32_t(m_probes.size());
    std::size_t next = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
        while (next == 0 || (passed < (k + 0.5) / count * area && next < triangles.size()))
            passed += double(triangleArea(mesh, triangles[next++]));
        const glm::vec2 square(radicalInverse(k + 1, 2), radicalInverse(k + 1, 3));
        for (std::uint32_t back = 0; back < chart.sides; ++back)
            m_probes.push_back({{triangles[next - 1], sampleTriangle(square)},
                                chart.instance,
                                back,
                                mixBits(chart.chart + mixBits(2 * k + back))});
    }
    chart.end = std::uint32_t(m_probes.size());
}

/// Traces cosine-weighted rays.
void DensityFinder::look(Probe& probe, Met* met) const {
    const WorldPoint point =
        worldPoint(m_scene, m_scene.instances[probe.instance], probe.point, probe.back != 0);
    const glm::mat3 toWorld = basisAround(point.normal);
    const glm::vec3 from = m_trace.clearOf(point.position, point.normal);
    const DirectionSet directions(m_rays, false, probe.seed);
    std::uint32_t backs = 0;
    for (std::uint32_t r = 0; r < m_rays; ++r) {
        // Heights are uniform in the set; for cosine-weighted rays their squares must be.
        const glm::vec3 d = directions[r];
        const float z2 = directions.height(r), flat = std::max(d.x * d.x + d.y * d.y, 1e-12f);
        const glm::vec2 disc = glm::vec2(d.x, d.y) * std::sqrt((1 - z2) / flat);
        const SurfaceHit hit = m_trace.closestSurface(
            {from, toWorld * glm::vec3(disc, std::sqrt(z2))}, TraceMask::Static);
        if (!hit)
            continue;
        const Instance& other = m_scene.instances[hit.instance];
        if (!hit.frontFace && !isTwoSided(m_scene, other))
            ++backs;
        else
            met[r] = {hit.instance,
                      {hit.triangle, {hit.u, hit.v}},
                      hit.frontFace ? 0U : 1U,
                      1 / std::max(hit.t, 1e-30f)};
    }
    probe.inSolid = 2 * backs > m_rays;
}

/// Harmonic mean of the distances, in units of the scene's size; distances are clamped to at least
/// `nearest` [m].
double DensityFinder::nearness(std::uint32_t probe, float nearest) const {
    double sum = 0;
    for (std::uint32_t r = 0; r < m_rays; ++r)
        sum += double(std::min(m_met[std::size_t(probe) * m_rays + r].perMetre, 1 / nearest));
    return sum / m_rays * m_size;
}

/// Computes the cubic root of each chart's mean fourth power. Small charts, and those whose probes
/// all lie in solids, use that of their instance, so an object that stands on a floor keeps its
/// texels when it is lifted.
void DensityFinder::findDetail(float nearest) {
    std::vector<double> sum(m_scene.instances.size()), open(sum.size());
    double texels = 0; // relative
    for (Chart& c : m_all) {
        double chartSum = 0, count = 0;
        for (std::uint32_t p = c.begin; p < c.end; ++p)
            if (!m_probes[p].inSolid) {
                chartSum += std::pow(nearness(p, nearest), 4);
                ++count;
            }
        c.detail = count > 0 ? std::cbrt(chartSum / count) : -1;
        sum[c.instance] += chartSum;
        open[c.instance] += count;
        texels += c.area * c.sides * std::max(c.detail, 0.);
    }
    for (Chart& c : m_all) {
        const double ofInstance =
            open[c.instance] > 0 ? std::cbrt(sum[c.instance] / open[c.instance]) : 0;
        if (c.detail < 0 || c.area * c.sides * ofInstance < kOwnDensity * texels)
            c.detail = ofInstance;
    }
}

/// Density class that most probes of a chart need.
int DensityFinder::usualClass(const Chart& chart) const {
    std::vector<int> all;
    for (std::uint32_t p = chart.begin; p < chart.end; ++p)
        if (!m_probes[p].inSolid)
            all.push_back(classAt(nearness(p, m_result.nearest)));
    if (all.empty())
        return densityClass(std::max(chart.detail, 1e-30), m_result.centre);
    const auto middle = all.begin() + std::ptrdiff_t(all.size() / 2);
    std::ranges::nth_element(all, middle);
    return *middle;
}

/// Calls visit(chart, hit, fours, area) for each ray that hit a chart: the chart's index in m_all,
/// the hit, the density class for the hit's distance, and the area that the ray represents [m^2].
template <class Visit>
void DensityFinder::forArrived(const Visit& visit) const {
    for (const Chart& c : m_all)
        for (std::size_t i = std::size_t(c.begin) * m_rays; i < std::size_t(c.end) * m_rays; ++i) {
            const Met& met = m_met[i];
            if (met.instance == ~0U || m_first[met.instance] == ~0U || m_probes[i / m_rays].inSolid)
                continue;
            const MeshCharts& charts = m_in.charts[m_scene.instances[met.instance].mesh];
            visit(m_first[met.instance] + charts.chartOfTriangle[met.point.triangle], met,
                  classAt(std::min(double(met.perMetre), 1. / m_result.nearest) * m_size),
                  c.area * c.sides / (c.end - c.begin) / m_rays);
        }
}

/// Number of texels that the near parts of each chart need, relative to their area at `fours` 0. A
/// part too small for probes of its own is found by the rays that arrive there: per area and
/// distance, as many arrive as would leave it.
std::vector<double> DensityFinder::nearWorth() const {
    // A block has 25 texels instead of 16, on every level, and extends beyond the part.
    constexpr double kBlocks = 2.5;
    std::vector<double> worth(m_all.size());
    forArrived([&](std::uint32_t chart, const Met&, int fours, double area) {
        if (fours >= m_all[chart].usual + kFar)
            worth[chart] += kBlocks * area * std::exp2(4 * fours);
    });
    return worth;
}

/// Collects the varied charts and the hits in their near parts.
std::vector<VariedChart> DensityFinder::varied() const {
    std::vector<VariedChart> result;
    std::vector<std::uint32_t> numbers(m_all.size(), ~0U);
    for (std::size_t i = 0; i < m_all.size(); ++i)
        if (m_all[i].varied) {
            numbers[i] = std::uint32_t(result.size());
            result.push_back({m_all[i].instance, m_all[i].chart, {}, {}, {}});
        }
    forArrived([&](std::uint32_t chart, const Met& met, int fours, double) {
        if (numbers[chart] == ~0U || fours < m_all[chart].fours + kFar)
            return;
        VariedChart& v = result[numbers[chart]];
        v.points.push_back(met.point);
        v.back.push_back(m_all[chart].sides > 1 ? met.back : 0);
        v.fours.push_back(fours);
    });
    return result;
}

/// Sets the density of a chart. Returns the number of texels it needs, as the area that they would
/// have at `fours` 0. A chart is varied if its near parts need a significant share of all texels,
/// or if a single density would waste one.
double DensityFinder::chooseChart(Chart& chart, double near) {
    const double area = chart.area * chart.sides;
    chart.even = densityClass(std::max(chart.detail, 1e-30), m_result.centre);
    const double wasted = area * (std::exp2(4 * chart.even) - std::exp2(4 * chart.usual)) - near;
    chart.varied = near >= kOwnDensity * m_worth || (near > 0 && wasted >= kWaste * m_worth);
    chart.fours = chart.varied ? chart.usual : chart.even;
    return area * std::exp2(4 * chart.fours) + (chart.varied ? near : 0);
}

/// Iterates, because the width of texels decides what they can resolve, and that determines their
/// number and so their width.
void DensityFinder::chooseDensities() {
    m_worth = m_area;
    double width = std::sqrt(m_area / m_texels); // where `fours` is 0 [m]
    for (int round = 0; round < 4; ++round) {
        m_result.nearest = float(kAlike * width);
        findDetail(m_result.nearest);
        double sum = 0, squares = 0, worth = 0, base = 0;
        for (const Chart& c : m_all) {
            sum += c.area * c.sides * c.detail;
            squares += c.area * c.sides * c.detail * c.detail;
        }
        if (!(sum > 0)) // nothing is near anything
            return;
        m_result.centre = squares / sum;
        m_classes = densityClassBounds(m_result.centre);
        for (double& bound : m_classes)
            bound = nearnessOf(bound);
        for (Chart& c : m_all)
            c.usual = usualClass(c);
        const std::vector<double> near = nearWorth();
        for (std::size_t i = 0; i < m_all.size(); ++i) {
            worth += chooseChart(m_all[i], near[i]);
            base += m_all[i].area * m_all[i].sides * std::exp2(4 * m_all[i].fours);
        }
        m_result.baseShare = worth > 0 ? base / worth : 1;
        m_worth = worth;
        width = std::sqrt(worth / m_texels);
    }
}

std::vector<std::vector<float>> DensityFinder::factors() const {
    std::vector<std::vector<float>> result(m_scene.instances.size());
    for (const Chart& c : m_all)
        result[c.instance].push_back(float(std::exp2(2 * c.fours)));
    return result;
}

/// Weights each hit by the number of texels that its probe would represent if no chart were varied:
/// a probe in a small near part of a chart represents much more than that part.
std::vector<MeshHits> DensityFinder::hits() const {
    std::vector<MeshHits> result(m_in.charts.size());
    for (const Chart& c : m_all) {
        for (std::uint32_t p = c.begin; p < c.end; ++p) {
            const double texels = c.area * c.sides * std::exp2(4 * c.even);
            for (std::uint32_t r = 0; r < m_rays && !m_probes[p].inSolid; ++r)
                if (const Met& met = m_met[std::size_t(p) * m_rays + r]; met.instance != ~0U) {
                    MeshHits& hits = result[m_scene.instances[met.instance].mesh];
                    hits.points.push_back(met.point);
                    hits.weight.push_back(float(texels / (c.end - c.begin)));
                }
        }
        result[m_scene.instances[c.instance].mesh].area += c.area * c.sides;
    }
    return result;
}

BakeDensity DensityFinder::run(const Progress& progress) {
    listCharts();
    addProbes();
    if (m_probes.empty())
        return {};
    const double rays = std::min(m_texels * kRaysPerTexel, kMaxRays);
    m_rays = std::uint32_t(std::clamp(rays / double(m_probes.size()), 8.0, 64.0));
    resizeLarge(m_met, m_probes.size() * m_rays);
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    if (!parallelRanges(m_probes.size(), 16, quiet, "charts",
                        [&](std::size_t begin, std::size_t end) {
                            for (std::size_t p = begin; p < end; ++p)
                                look(m_probes[p], &m_met[p * m_rays]);
                        }))
        return {};
    chooseDensities();
    m_result.texels = factors();
    m_result.surfels = surfelDensities(m_scene, m_in.charts, m_in.shapes, hits());
    m_result.varied = varied();
    m_result.size = m_size;
    m_result.rays = m_met.size();
    return std::move(m_result);
}

} // namespace

double detailOf(double nearness) {
    return std::cbrt(std::pow(nearness, 4));
}

double nearnessOf(double detail) {
    return std::pow(detail, 0.75);
}

BakeDensity findDensity(const TraceScene& trace, const std::vector<MeshCharts>& charts,
                        std::uint32_t texels, const Progress& progress) {
    return DensityFinder(trace, charts, texels).run(progress);
}

} // namespace limn
