// SPDX-License-Identifier: MIT
#include "engine/lightmap/texel_sides.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/texel_snaps.h"
#include "engine/math/sampling.h"
#include "engine/trace/clear_along.h"

#include <algorithm>
#include <atomic>

#include <glm/geometric.hpp>

namespace limn {

static constexpr std::uint32_t kProbesPerPoint = 8, kSlots = AtlasTexel::kMaxPoints;

std::uint32_t chartOfTexel(const MeshCharts& charts, const AtlasTexel& texel) {
    const std::uint32_t chart = charts.chartOfTriangle[texel.points[0].triangle];
    for (std::uint32_t k = 1; k < texel.count; ++k)
        if (charts.chartOfTriangle[texel.points[k].triangle] != chart)
            return kMixedCharts;
    return chart;
}

std::uint32_t SideFinder::chartOf(const AtlasTexel& texel) const {
    return chartOfTexel(atlas.layout.meshes[trace.scene().instances[texel.instance].mesh], texel);
}

Outlook SideFinder::look(const WorldPoint& point, float reach, std::uint32_t seed) const {
    constexpr float kFar = 1000;
    const DirectionSet directions(kProbesPerPoint, false, seed);
    const glm::mat3 toWorld = basisAround(point.normal);
    const glm::vec3 from = trace.clearOf(point.position, point.normal);
    Outlook result;
    for (std::uint32_t i = 0; i < kProbesPerPoint; ++i) {
        const SurfaceHit hit =
            trace.closestSurface({from, toWorld * directions[i]}, TraceMask::Static);
        const bool inSolid = hit && !hit.frontFace &&
                             !isTwoSided(trace.scene(), trace.scene().instances[hit.instance]);
        result.open += inSolid || (hit && hit.t < reach) ? 0 : 1;
        result.distances += hit ? std::min(hit.t, kFar * reach) : kFar * reach;
    }
    return result;
}

LiftedPoint SideFinder::lift(const WorldPoint& point, float reach, std::uint32_t instance,
                             std::uint32_t chart) const {
    constexpr float kHeight = 0.25f; // [texels]
    ++rays;
    return {raise(trace, point, kHeight * reach).position, instance, chart};
}

LiftedPoint SideFinder::lift(const MeshPoint& point, const AtlasTexel& texel,
                             std::uint32_t chart) const {
    const Instance& instance = trace.scene().instances[texel.instance];
    return lift(worldPoint(trace.scene(), instance, point, texel.back != 0), texel.width,
                texel.instance, chart);
}

bool SideFinder::sees(const LiftedPoint& a, const LiftedPoint& b) const {
    return clearAlong(trace, a.position, b.position, [&](const Hit& hit) {
        return hit.instance == a.instance && chartOf(hit.instance, hit.triangle) == a.chart;
    });
}

TexelSide SideFinder::choose(AtlasTexel& texel) const {
    const Scene& scene = trace.scene();
    TexelSide side{.chart = chartOf(texel)};
    const std::uint32_t seed = seedOf(scene, texel);
    std::array<std::uint32_t, kSlots> open{}, setOf{}; // its first member identifies a set
    std::array<float, kSlots> distances{};
    std::array<LiftedPoint, kSlots> lifted;
    std::uint32_t first = 0;
    for (std::uint32_t k = 0; k < texel.count; ++k) {
        const WorldPoint p = texelPoint(scene, texel, k);
        const Outlook outlook = look(p, texel.width, seed + k);
        open[k] = outlook.open;
        distances[k] = outlook.distances;
        lifted[k] = lift(p, texel.width, texel.instance, side.chart);
        first = open[k] > open[first] ? k : first;
    }
    side.open = open[first] > 0;
    rays += texel.count * kProbesPerPoint;
    // Joins the points that see one another into sets. Usually one point sees all others.
    for (std::uint32_t k = 0; k < texel.count; ++k)
        setOf[k] = k;
    for (std::uint32_t pass = 0; pass < 2 && side.chart != kMixedCharts; ++pass)
        for (std::uint32_t a = 0; a < texel.count; ++a)
            for (std::uint32_t b = 0; b < texel.count; ++b)
                if (open[a] > 0 && open[b] > 0 && setOf[a] != setOf[b] &&
                    (pass == 0 ? a == first : a < b)) {
                    ++rays;
                    if (sees(lifted[a], lifted[b]))
                        std::ranges::replace(setOf, std::max(setOf[a], setOf[b]),
                                             std::min(setOf[a], setOf[b]));
                }
    std::array<std::uint32_t, kSlots> sum{};
    for (std::uint32_t k = 0; k < texel.count; ++k)
        sum[setOf[k]] += open[k];
    const auto best = std::uint32_t(std::ranges::max_element(sum) - sum.begin());
    for (std::uint32_t k = 0; k < texel.count; ++k)
        if (side.chart != kMixedCharts && setOf[k] != best && open[k] > 0) {
            open[k] = 0;
            side.split = true;
        }
    for (std::uint32_t k = 0; k < texel.count; ++k)
        if (open[k] > 0 || !side.open) {
            side.points[side.count++] = lifted[k];
            side.clearance += distances[k];
        }
    side.clearance /= float(kProbesPerPoint * side.count);
    if (!side.open || texel.count == 1)
        return side;
    std::uint32_t total = 0;
    for (const std::uint32_t n : open)
        total += n;
    const std::array<MeshPoint, kSlots> from = texel.points;
    std::uint32_t k = 0, passed = open[0]; // of the points up to k
    for (std::uint32_t slot = 0; slot < kSlots; ++slot) {
        while (2 * kSlots * passed <= (2 * slot + 1) * total)
            passed += open[++k];
        texel.points[slot] = from[k];
    }
    texel.count = kSlots;
    return side;
}

PlacedTriangle placeTriangle(const LightmapLayout& layout, std::uint32_t mesh,
                             std::uint32_t instance, std::uint32_t back, std::uint32_t triangle) {
    const MeshCharts& charts = layout.meshes[mesh];
    const InstanceLightmap& map = layout.instances[instance];
    const glm::ivec2 size(int(layout.width), int(layout.height));
    PlacedTriangle placed{instance, back, triangle, {}, glm::ivec2(0), size};
    for (std::uint32_t k = 0; k < 3; ++k)
        placed.corner[k] = map.uv[charts.indices[3 * triangle + k]] * glm::vec2(size) +
                           glm::vec2(0, float(back * map.backRows)) - 0.5f;
    return placed;
}

TexelSides findTexelSides(const TraceScene& trace, const Atlas& atlas,
                          const std::vector<PlacedTriangle>& placed, const Progress& progress) {
    TexelSides result{.texels = atlas.texels};
    std::atomic<std::uint64_t> rays = 0;
    const SideFinder sides{trace, atlas, rays};
    std::vector<TexelSide> side(result.texels.size());
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    const bool done = parallelRanges(result.texels.size(), 64, quiet, "charts",
                                     [&](std::size_t begin, std::size_t end) {
                                         for (std::size_t t = begin; t < end; ++t)
                                             side[t] = sides.choose(result.texels[t]);
                                     });
    for (const TexelSide& s : side)
        result.open.push_back(s.open ? 1 : 0);
    if (done)
        result.snaps = findSnaps(sides, result.texels, side, placed, progress);
    result.rays = rays;
    return result;
}

struct SideLookup::State {
    State(const TraceScene& trace, const Atlas& a)
        : atlas(a), sides{trace, a, rays},
          texelAt(std::size_t(a.layout.width) * a.layout.height, ~0U), side(a.texels.size()) {}

    const Atlas& atlas;
    mutable std::atomic<std::uint64_t> rays = 0;
    SideFinder sides;
    std::vector<std::uint32_t> texelAt; ///< per place of the atlas: into Atlas::texels
    std::vector<TexelSide> side;        ///< of texels about places with snaps

    void know(std::uint32_t texel);
    std::array<std::uint32_t, 4> texelsAt(std::uint32_t place) const;
};

/// Collects the distinct points of a texel, raised above the surface.
void SideLookup::State::know(std::uint32_t texel) {
    const AtlasTexel& t = atlas.texels[texel];
    TexelSide& s = side[texel];
    if (s.count > 0)
        return;
    s.chart = sides.chartOf(t);
    s.open = atlas.open[texel] != 0;
    for (std::uint32_t k = 0; k < t.count; ++k)
        if (std::find(t.points.begin(), t.points.begin() + k, t.points[k]) == t.points.begin() + k)
            s.points[s.count++] = sides.lift(t.points[k], t, s.chart);
}

std::array<std::uint32_t, 4> SideLookup::State::texelsAt(std::uint32_t place) const {
    const std::uint32_t width = atlas.layout.width, x = place % width, y = place / width;
    const auto texel = [&](std::uint32_t i, std::uint32_t j) {
        return i < width && j < atlas.layout.height ? texelAt[std::size_t(j) * width + i] : ~0U;
    };
    return {texel(x, y), texel(x + 1, y), texel(x, y + 1), texel(x + 1, y + 1)};
}

SideLookup::SideLookup(const TraceScene& trace, const Atlas& atlas)
    : m_state(std::make_unique<State>(trace, atlas)) {
    State& s = *m_state;
    for (std::uint32_t i = 0; i < atlas.texels.size(); ++i)
        s.texelAt[atlas.texels[i].texel] = i;
    for (std::uint32_t p = 0; p < s.texelAt.size() && !atlas.layout.snaps.empty(); ++p)
        if (atlas.layout.snaps[p] != 0)
            for (const std::uint32_t t : s.texelsAt(p))
                if (t != ~0U)
                    s.know(t);
}

SideLookup::~SideLookup() = default;

std::uint64_t SideLookup::rays() const {
    return m_state->rays;
}

glm::vec2 SideLookup::uvOf(std::uint32_t instance, const MeshPoint& point, bool back) const {
    const State& s = *m_state;
    const LightmapLayout& layout = s.atlas.layout;
    const std::uint32_t mesh = s.sides.trace.scene().instances[instance].mesh;
    const glm::vec2 uv = unsnappedUv(layout, instance, mesh, point.triangle, point.barycentric.x,
                                     point.barycentric.y, back);
    const AtlasLookup l = lookupAt(layout, uv);
    if (!l.inside || l.snaps == 0)
        return snapLookup(layout, uv);
    const auto place = std::size_t(l.base.y) * layout.width + std::size_t(l.base.x);
    const std::uint32_t chart = s.sides.chartOf(instance, point.triangle);
    std::array<std::uint32_t, 4> texel = s.texelsAt(std::uint32_t(place));
    for (std::uint32_t& t : texel)
        if (t != ~0U && (s.side[t].chart != chart || s.atlas.texels[t].instance != instance))
            t = ~0U;
    const auto* owner = std::ranges::find_if(texel, [](std::uint32_t t) { return t != ~0U; });
    if (owner == texel.end())
        return snapLookup(layout, uv);
    const LiftedPoint from = s.sides.lift(point, s.atlas.texels[*owner], chart);
    const std::uint32_t snap = chooseSnap(s.sides, s.side, texel, from, l.f);
    return snap == kSnaps ? snapLookup(layout, uv) : snappedUv(layout, l.base, l.f, snap);
}

} // namespace limn
