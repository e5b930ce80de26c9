// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/overlay/texel_overlay.h"

#include "engine/lightmap/fine_blocks.h"
#include "engine/overlay/palette.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace limn {

namespace {

constexpr int kSide = 4; // points per texel and axis; 16 fit a mask

const glm::vec3 kSingle(0.23f, 0.36f, 0.55f), kShared(0.99f, 0.75f, 0.25f), kOverlap(1, 0, 1);

/// A triangle of an instance in the atlas and in the world.
struct AtlasTriangle {
    std::array<glm::vec2, 3> corner; ///< [texels]
    double area;                     ///< [m^2]

    double texels() const {
        const glm::dvec2 a(corner[1] - corner[0]), b(corner[2] - corner[0]);
        return 0.5 * std::abs(a.x * b.y - a.y * b.x);
    }
};

/// Extent of a chart, for charts too small to cover texels.
struct ChartExtent {
    glm::vec2 lower{std::numeric_limits<float>::max()}, upper{0}; ///< texels
    double area = 0;                                              ///< [m^2]

    bool collapsed() const {
        const glm::vec2 size = upper - lower;
        return std::min(size.x, size.y) < 0.5f;
    }
    /// Texels per metre: a chart of n x m texels has its borders on texel centres.
    double density() const {
        const glm::dvec2 size(upper - lower);
        return std::sqrt((std::round(size.x) + 1) * (std::round(size.y) + 1) /
                         std::max(area, 1e-30));
    }
};

struct Raster {
    const LightmapLayout& layout;
    TexelUse use;
    std::vector<std::uint16_t> covered; ///< points of each texel that lie in a triangle
    std::vector<float> weight;          ///< sum of the weights of the samples in `density`

    void add(const AtlasTriangle& t, std::uint32_t chart, float density);
    void addTexel(std::size_t texel, std::uint32_t chart, std::uint16_t points, float density);
};

double cross(glm::vec2 a, glm::vec2 b) {
    return double(a.x) * double(b.y) - double(a.y) * double(b.x);
}

} // namespace

static bool hasLightmap(const LightmapLayout& layout, const Scene& scene, std::size_t i) {
    return i < layout.instances.size() && !layout.instances[i].uv.empty() &&
           !layout.meshes[scene.instances[i].mesh].indices.empty();
}

/// Triangle of the front side.
static AtlasTriangle atlasTriangle(const LightmapLayout& layout, const Scene& scene,
                                   std::size_t instance, std::size_t t) {
    const Instance& inst = scene.instances[instance];
    const MeshCharts& charts = layout.meshes[inst.mesh];
    const glm::vec2 size(layout.width, layout.height);
    AtlasTriangle out{};
    std::array<glm::vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = charts.indices[3 * t + k];
        out.corner[k] = layout.instances[instance].uv[v] * size;
        p[k] = inst.toWorld * glm::vec4(scene.meshOf(inst).positions[charts.sourceVertex[v]], 1);
    }
    out.area = 0.5 * double(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
    return out;
}

// Bits of the points of texel (x, y) strictly inside the triangle. The points avoid the simple
// fractions at which edges like to lie.
static std::uint16_t pointsInside(const std::array<glm::vec2, 3>& t, int x, int y) {
    const double area = cross(t[1] - t[0], t[2] - t[0]);
    const double minArea = 1e-4 * std::abs(area);
    std::uint16_t bits = 0;
    if (area == 0)
        return 0;
    for (int k = 0; k < kSide * kSide; ++k) {
        const glm::vec2 p =
            glm::vec2(x, y) +
            (glm::vec2(k % kSide, k / kSide) + glm::vec2(0.4142f, 0.5857f)) / float(kSide);
        const double side = area > 0 ? 1 : -1;
        if (side * cross(t[1] - t[0], p - t[0]) > minArea &&
            side * cross(t[2] - t[1], p - t[1]) > minArea &&
            side * cross(t[0] - t[2], p - t[2]) > minArea)
            bits = std::uint16_t(bits | 1u << k);
    }
    return bits;
}

// Whether the triangle meets the open square of half-width 1 around the texel's centre, which is
// the reach of its bilinear weight.
static bool looksUp(const std::array<glm::vec2, 3>& t, int x, int y) {
    constexpr float kReach = 0.999f;
    const glm::vec2 c(float(x) + 0.5f, float(y) + 0.5f);
    const glm::vec2 lower = glm::min(glm::min(t[0], t[1]), t[2]),
                    upper = glm::max(glm::max(t[0], t[1]), t[2]);
    if (glm::any(glm::greaterThan(lower, c + kReach)) || glm::any(glm::lessThan(upper, c - kReach)))
        return false;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec2 edge = t[(k + 1) % 3] - t[k];
        const glm::vec2 n(-edge.y, edge.x);
        const float height = glm::dot(n, t[(k + 2) % 3] - t[k]), distance = glm::dot(n, c - t[k]);
        const float reach = kReach * (std::abs(n.x) + std::abs(n.y));
        if (height > 0 ? distance < -reach || distance > height + reach
                       : distance > reach || distance < height - reach)
            return false;
    }
    return true;
}

void Raster::addTexel(std::size_t texel, std::uint32_t chart, std::uint16_t points, float density) {
    using Kind = TexelUse::Kind;
    Kind& kind = use.kind[texel];
    if (covered[texel] & points)
        kind = Kind::Overlap;
    else if (kind == Kind::Unused)
        kind = Kind::Single, use.chart[texel] = chart;
    else if (kind == Kind::Single && use.chart[texel] != chart)
        kind = Kind::Shared;
    covered[texel] = std::uint16_t(covered[texel] | points);
    const float w = float(std::popcount(points)) + 0.01f;
    use.density[texel] += w * density;
    weight[texel] += w;
}

void Raster::add(const AtlasTriangle& t, std::uint32_t chart, float density) {
    const glm::vec2 lower = glm::min(glm::min(t.corner[0], t.corner[1]), t.corner[2]) - 1.5f;
    const glm::vec2 upper = glm::max(glm::max(t.corner[0], t.corner[1]), t.corner[2]) + 0.5f;
    const glm::ivec2 last(int(layout.width) - 1, int(layout.height) - 1);
    const glm::ivec2 from = glm::max(glm::ivec2(glm::floor(lower)), 0);
    const glm::ivec2 to = glm::min(glm::ivec2(glm::ceil(upper)), last);
    for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x)
            if (looksUp(t.corner, x, y))
                addTexel(std::size_t(y) * layout.width + std::size_t(x), chart,
                         pointsInside(t.corner, x, y), density);
}

static void addInstance(Raster& raster, const Scene& scene, std::size_t i) {
    const LightmapLayout& layout = raster.layout;
    const MeshCharts& charts = layout.meshes[scene.instances[i].mesh];
    const std::uint32_t backRows = layout.instances[i].backRows;
    std::vector<AtlasTriangle> triangles;
    std::vector<ChartExtent> extents(charts.chartSize.size());
    for (std::size_t t = 0; t < charts.chartOfTriangle.size(); ++t) {
        triangles.push_back(atlasTriangle(layout, scene, i, t));
        ChartExtent& e = extents[charts.chartOfTriangle[t]];
        e.area += triangles[t].area;
        for (const glm::vec2 p : triangles[t].corner)
            e.lower = glm::min(e.lower, p), e.upper = glm::max(e.upper, p);
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const std::uint32_t chart = charts.chartOfTriangle[t];
        const ChartExtent& e = extents[chart];
        const double density =
            e.collapsed() ? e.density()
                          : std::sqrt(triangles[t].texels() / std::max(triangles[t].area, 1e-30));
        raster.add(triangles[t], raster.use.charts + chart, float(density));
        if (backRows == 0)
            continue;
        for (glm::vec2& p : triangles[t].corner)
            p.y += float(backRows);
        raster.add(triangles[t], raster.use.charts + chart, float(density));
    }
    raster.use.charts += std::uint32_t(extents.size());
}

/// Assigns finer texels to the charts of the texels that they stand for.
static void addFineTexels(const LightmapLayout& layout, TexelUse& use) {
    constexpr std::uint32_t kBlock = kFineCells + 1;
    // Blocks come after what they stand for.
    for (std::size_t place = 0; place < use.kind.size() && place < layout.snaps.size(); ++place)
        for (std::uint32_t k = 0; (layout.snaps[place] & kFineLookup) && k < kBlock * kBlock; ++k) {
            const std::size_t fineTexel = std::size_t(layout.snaps[place] & ~kFineLookup) +
                                          std::size_t(k / kBlock) * layout.width + k % kBlock;
            use.kind[fineTexel] = use.kind[place];
            use.chart[fineTexel] = use.chart[place];
            use.density[fineTexel] = use.density[place] * float(kFineCells);
        }
}

TexelUse texelUse(const LightmapLayout& layout, const Scene& scene) {
    const std::size_t count = std::size_t(layout.width) * layout.height;
    Raster raster{layout, {}, std::vector<std::uint16_t>(count), std::vector<float>(count)};
    raster.use.kind.resize(count);
    raster.use.chart.assign(count, ~0u);
    raster.use.density.resize(count);
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (hasLightmap(layout, scene, i))
            addInstance(raster, scene, i);
    for (std::size_t k = 0; k < count; ++k)
        if (raster.weight[k] > 0)
            raster.use.density[k] /= raster.weight[k];
    addFineTexels(layout, raster.use);
    return std::move(raster.use);
}

static void paintCharts(const TexelUse& use, OverlayData& out) {
    for (std::size_t k = 0; k < out.texels.size(); ++k)
        if (use.chart[k] != ~0u)
            out.texels[k] = packColor(distinctColor(use.chart[k]));
    const auto used = std::ranges::count_if(use.chart, [](std::uint32_t c) { return c != ~0u; });
    out.legend = {
        "UV charts",
        {},
        {fmt::format("One colour per chart, {} charts; the checker is texels", use.charts),
         fmt::format("{} x {} texels, {:.1f} % of them in a chart", out.width, out.height,
                     100 * double(used) / double(out.texels.size()))}};
}

// The range of density, widened to powers of 2, beyond which lie at most 1 % of the texels on
// either side.
static glm::vec2 densityRange(const TexelUse& use) {
    std::vector<float> sorted;
    std::ranges::copy_if(use.density, std::back_inserter(sorted), [](float d) { return d > 0; });
    if (sorted.empty())
        return {1, 2};
    std::ranges::sort(sorted);
    const std::size_t skip = sorted.size() / 100;
    const float low = std::exp2(std::floor(std::log2(sorted[skip])));
    const float high = std::exp2(std::ceil(std::log2(sorted[sorted.size() - 1 - skip])));
    return {low, std::max(high, 2 * low)};
}

static void paintDensity(const TexelUse& use, OverlayData& out) {
    const glm::vec2 range = densityRange(use);
    const float octaves = std::log2(range.y / range.x);
    for (std::size_t k = 0; k < out.texels.size(); ++k)
        if (use.density[k] > 0)
            out.texels[k] = packColor(viridis(std::log2(use.density[k] / range.x) / octaves));
    out.legend = {"Texels per metre", {}, {"The checker is texels; 1 % lie outside either end"}};
    for (int k = 4; k >= 0; --k) {
        const float t = float(k) / 4;
        out.legend.entries.push_back(
            {packColor(viridis(t)),
             fmt::format("{:.3g} per metre", range.x * std::exp2(octaves * t))});
    }
}

static void paintOverlap(const TexelUse& use, OverlayData& out) {
    using Kind = TexelUse::Kind;
    std::array<std::uint64_t, 4> count{};
    for (std::size_t k = 0; k < out.texels.size(); ++k) {
        ++count[std::size_t(use.kind[k])];
        switch (use.kind[k]) {
        case Kind::Unused:
            break;
        case Kind::Single:
            out.texels[k] = packColor(kSingle);
            break;
        case Kind::Shared:
            out.texels[k] = packColor(kShared);
            break;
        case Kind::Overlap:
            out.texels[k] = packColor(kOverlap);
            break;
        }
    }
    out.legend = {
        "UV overlap",
        {{packColor(kSingle), fmt::format("one chart: {} texels", count[1])},
         {packColor(kShared), fmt::format("looked up by several charts: {} texels", count[2])},
         {packColor(kOverlap), fmt::format("surfaces lie over each other: {} texels", count[3])}},
        {"Charts smaller than a texel share one with their neighbours by design"}};
}

OverlayData texelOverlay(const Bake& bake, const Scene& scene, Overlay kind) {
    const TexelUse use = texelUse(bake.lightmap, scene);
    OverlayData out;
    out.width = bake.lightmap.width;
    out.height = bake.lightmap.height;
    out.texels.resize(use.kind.size());
    out.finer = fineBlocks(bake.lightmap);
    if (kind == Overlay::Charts)
        paintCharts(use, out);
    else if (kind == Overlay::Density)
        paintDensity(use, out);
    else
        paintOverlap(use, out);
    const auto without = std::size_t(std::ranges::count_if(
        bake.lightmap.instances, [](const InstanceLightmap& i) { return i.uv.empty(); }));
    if (without > 0)
        out.legend.notes.push_back(fmt::format(
            "{} instances without lightmap are left grey: they are lit from the grid", without));
    return out;
}

} // namespace limn
