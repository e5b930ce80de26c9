// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/chart_crossings.h"

#include "engine/core/parallel.h"
#include "engine/final_lightmap/texel_lookups.h"

#include <algorithm>
#include <cstddef>

#include <glm/geometric.hpp>

namespace limn {

namespace {

/// Height above the surface at which rays run along it, relative to their length.
constexpr float kHeight = 0.02f;

struct Crossing {
    std::uint32_t instance, chart;
    glm::vec2 uv;
};

struct CrossingFinder {
    const TraceScene& trace;
    const std::vector<MeshCharts>& charts;
    const CutScene& cut;
    const LitTexels& lit;

    const MeshCharts& chartsOf(std::uint32_t instance) const {
        return charts[trace.scene().instances[instance].mesh];
    }
    void look(std::uint32_t instance, bool back, const MeshPoint& from, const MeshPoint& to,
              std::vector<Crossing>& found) const;
    void lookAround(std::uint32_t t, std::vector<Crossing>& found) const;
};

/// Looks from one point of a chart to another.
void CrossingFinder::look(std::uint32_t instance, bool back, const MeshPoint& from,
                          const MeshPoint& to, std::vector<Crossing>& found) const {
    const MeshCharts& mesh = chartsOf(instance);
    const std::uint32_t chart = mesh.chartOfTriangle[from.triangle];
    if (mesh.chartOfTriangle[to.triangle] != chart)
        return;
    const Hit a = hitOfPoint(trace.scene(), instance, from, back),
              b = hitOfPoint(trace.scene(), instance, to, back);
    const float height = std::max(kHeight * glm::distance(a.position, b.position),
                                  2 * trace.epsilonAt(a.position)),
                side = back ? -height : height;
    const glm::vec3 start = a.position + side * a.geometricNormal,
                    way = b.position + side * b.geometricNormal - start;
    const float length = glm::length(way);
    if (!(length > 0))
        return;
    const SurfaceHit hit =
        trace.closestSurface({start, way / length, 0, length}, TraceMask::Static);
    if (!hit || (hit.instance == instance && mesh.chartOfTriangle[hit.triangle] == chart))
        return;
    const float share = hit.t / length;
    found.push_back(
        {instance, chart, chartUvAt(mesh, from) * (1 - share) + chartUvAt(mesh, to) * share});
}

/// Looks from the texel's first point to its others and to the next texels, and back: the two faces
/// of a wall are two lines.
void CrossingFinder::lookAround(std::uint32_t t, std::vector<Crossing>& found) const {
    const AtlasTexel& texel = lit.atlas.texels[t];
    const MeshPoint first = cut.toSource(texel.instance, texel.points[0]);
    const auto lookAt = [&](const MeshPoint& point) {
        const MeshPoint other = cut.toSource(texel.instance, point);
        look(texel.instance, texel.back != 0, first, other, found);
        look(texel.instance, texel.back != 0, other, first, found);
    };
    for (std::uint32_t k = 1; k < texel.count; ++k)
        lookAt(texel.points[k]);
    forNextTexels(lit, t, [&](std::uint32_t next) { lookAt(lit.atlas.texels[next].points[0]); });
}

} // namespace

glm::vec2 chartUvAt(const MeshCharts& charts, const MeshPoint& point) {
    const auto corner = [&](std::size_t k) {
        return charts.chartUv[charts.indices[3 * std::size_t(point.triangle) + k]];
    };
    const glm::vec2 b = point.barycentric;
    return corner(0) * (1 - b.x - b.y) + corner(1) * b.x + corner(2) * b.y;
}

ChartCrossings findCrossings(const TraceScene& trace, const std::vector<MeshCharts>& charts,
                             const CutScene& cut, const LitTexels& lit, const Progress& progress) {
    constexpr std::size_t kBlock = 256; // texels
    const CrossingFinder finder{trace, charts, cut, lit};
    const std::size_t texels = lit.atlas.texels.size();
    std::vector<std::vector<Crossing>> found((texels + kBlock - 1) / kBlock);
    parallelRanges(found.size(), 1, progress, "texels", [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b)
            for (std::size_t t = b * kBlock; t < std::min(texels, (b + 1) * kBlock); ++t)
                finder.lookAround(std::uint32_t(t), found[b]);
    });
    ChartCrossings crossings(trace.scene().instances.size());
    for (std::uint32_t i = 0; i < crossings.size(); ++i)
        crossings[i].resize(finder.chartsOf(i).chartSize.size());
    for (const std::vector<Crossing>& block : found)
        for (const Crossing& c : block)
            crossings[c.instance][c.chart].push_back(c.uv);
    return crossings;
}

} // namespace limn
