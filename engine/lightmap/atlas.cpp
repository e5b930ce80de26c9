// SPDX-License-Identifier: MIT
#include "engine/lightmap/atlas.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/texel_cover.h"
#include "engine/trace/trace_scene.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stb/stb_rect_pack.h>

namespace limn {

namespace {

/// Total area [m^2], computed with the scales that the charts get.
double lightmappedArea(const AtlasInput& in) {
    double sum = 0;
    for (std::size_t i = 0; i < in.scene.instances.size(); ++i) {
        const Instance& instance = in.scene.instances[i];
        if (!hasLightmap(in, instance))
            continue;
        const std::vector<double>& area = in.shapes[instance.mesh].area;
        double mesh = 0;
        for (std::uint32_t c = 0; c < area.size(); ++c)
            mesh += area[c] * std::pow(double(in.factorOf(std::uint32_t(i), c)), 2);
        sum += mesh * double(in.scale[i]) * double(in.scale[i]) * sidesOf(in, instance);
    }
    return sum;
}

/// Number of texels read by lookups at a density.
std::uint32_t countAt(const AtlasInput& in, float density, const Progress& progress) {
    const std::vector<ChartPlace> places = placeCharts(in, density);
    std::atomic<std::uint32_t> count = 0;
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    parallelRanges(places.size(), 64, quiet, "charts", [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint8_t> scratch;
        std::uint32_t sum = 0;
        for (std::size_t p = begin; p < end; ++p)
            sum += countTexels(in, places[p], scratch) * places[p].sides;
        count += sum;
    });
    return count;
}

/// Finds the density [texels per metre] of the form 2^(k / 256), k an integer, whose texel count is
/// nearest below `wanted`; small changes of a scene therefore do not change its density and texels.
/// Uses secants between the nearest known densities on either side, because the count is nearly a
/// power of the density. A side that does not move is approached by steps that double.
float findDensity(const AtlasInput& in, std::uint32_t wanted, const Progress& progress) {
    const double area = lightmappedArea(in);
    if (!(area > 0))
        return 1;
    constexpr int kSteps = 256; // per octave
    const auto density = [](int k) { return float(std::exp2(double(k) / kSteps)); };
    const int middle = int(std::floor(std::log2(wanted / area) / 2 * kSteps));
    int low = middle - 6 * kSteps, high = middle + kSteps;
    double lowExcess = -1, highExcess = 1; // log of count / wanted; guessed till counted
    bool lowKnown = false, highKnown = false;
    int next = middle - kSteps / 2, beyond = 1;
    while (high - low > 1 && !progress.cancelled()) {
        const int k = std::clamp(next, low + 1, high - 1);
        const std::uint32_t count = countAt(in, density(k), progress);
        const double excess = std::log(std::max(count, 1U) / double(wanted));
        const bool above = count > wanted;
        (above ? high : low) = k;
        (above ? highExcess : lowExcess) = excess;
        (above ? highKnown : lowKnown) = true;
        // The count grows approximately as density^1.5.
        const double slope = lowKnown && highKnown ? (highExcess - lowExcess) / (high - low)
                                                   : 1.5 * std::log(2.) / kSteps;
        const double guess = k - excess / std::max(slope, 1e-9);
        next = above ? int(std::floor(guess)) : int(std::ceil(guess));
        next = above ? std::min(next, k - beyond) : std::max(next, k + beyond);
        // A larger step would leave the range.
        beyond = std::min(2 * beyond, high - low + kSteps);
    }
    return density(low);
}

/// Packs the places with that many sides into rows of texels from `top` on and sets their offsets.
/// Returns the number of rows used.
std::uint32_t packPlaces(std::vector<ChartPlace>& places, std::uint32_t sides, std::uint32_t width,
                         std::uint32_t top) {
    std::vector<stbrp_rect> rects;
    std::uint32_t tallestSum = 1, rows = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (places[i].sides == sides) {
            rects.push_back({int(i), int(places[i].size.x), int(places[i].size.y), 0, 0, 0});
            tallestSum += places[i].size.y;
        }
    std::vector<stbrp_node> nodes(width);
    stbrp_context context;
    stbrp_init_target(&context, int(width), int(std::min(tallestSum, 1U << 30)), nodes.data(),
                      int(nodes.size()));
    stbrp_pack_rects(&context, rects.data(), int(rects.size()));
    for (const stbrp_rect& r : rects) {
        assert(r.was_packed);
        places[std::size_t(r.id)].offset = {r.x, int(top) + r.y};
        rows = std::max(rows, std::uint32_t(r.y + r.h));
    }
    return rows;
}

/// Packs the places and sets the atlas size: the fronts of two-sided instances at the top, their
/// backs in the same order below, and all others under both. One offset thus leads from every front
/// to its back.
void packAtlas(std::vector<ChartPlace>& places, LightmapLayout& layout) {
    std::uint64_t area = 0;
    std::uint32_t widest = 1;
    for (const ChartPlace& p : places) {
        area += std::uint64_t(p.size.x) * p.size.y * p.sides;
        widest = std::max(widest, p.size.x);
    }
    layout.width = std::max(widest, std::uint32_t(std::ceil(std::sqrt(double(area) * 1.1))));
    const std::uint32_t backRows = packPlaces(places, 2, layout.width, 0);
    layout.height = std::max(1U, 2 * backRows + packPlaces(places, 1, layout.width, 2 * backRows));
    for (const ChartPlace& p : places)
        if (p.sides == 2)
            layout.instances[p.instance].backRows = backRows;
}

void writeUv(const ChartPlace& place, const AtlasInput& in, LightmapLayout& layout) {
    const std::uint32_t mesh = in.scene.instances[place.instance].mesh;
    const MeshCharts& charts = in.charts[mesh];
    std::vector<glm::vec2>& uv = layout.instances[place.instance].uv;
    uv.resize(charts.sourceVertex.size());
    const glm::vec2 size(float(layout.width), float(layout.height));
    for (const std::uint32_t c : place.charts)
        for (const std::uint32_t t : in.shapes[mesh].trianglesOf(c))
            for (std::uint32_t k = 0; k < 3; ++k)
                uv[charts.indices[3 * t + k]] =
                    (glm::vec2(place.offset) + cornerInPlace(in, place, t, k)) / size;
}

} // namespace

LightmapLayout layoutWithoutLightmap(const Scene& scene) {
    LightmapLayout layout;
    layout.meshes.resize(scene.assets->meshes.size());
    layout.instances.resize(scene.instances.size());
    return layout;
}

double wantedTexels(const Scene& scene) {
    const double perMetre = scene.bake.texelsPerMetre;
    if (!(perMetre > 0))
        return scene.bake.lightmapCaches;
    double area = 0;
    for (const Instance& i : scene.instances)
        if (!i.dynamic)
            area += worldArea(scene, i) * (isTwoSided(scene, i) ? 2 : 1) *
                    std::pow(double(i.texelDensity), 2);
    return area * perMetre * perMetre;
}

float atlasScale(const Instance& instance) {
    const float scale = std::cbrt(std::abs(glm::determinant(glm::mat3(instance.toWorld))));
    int exponent;
    const float mantissa = std::frexp(scale, &exponent);
    constexpr float kSteps = 4096; // hides what a rotation's rounding does to the determinant
    return std::isfinite(scale) ? std::ldexp(std::round(mantissa * kSteps) / kSteps, exponent) : 0;
}

Atlas buildAtlas(const Scene& scene, std::vector<MeshCharts> charts, const BakeSettings& settings,
                 std::vector<std::vector<float>> factors, const Progress& progress) {
    AtlasInput in = atlasInput(scene, charts);
    in.factor = std::move(factors);
    Atlas atlas;
    atlas.texelsPerMetre = settings.texelsPerMetre > 0
                               ? settings.texelsPerMetre
                               : findDensity(in, settings.lightmapCaches, progress);
    std::vector<ChartPlace> places = placeCharts(in, atlas.texelsPerMetre);
    std::vector<std::vector<LocalTexel>> covered(places.size());
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    const bool done =
        parallelRanges(places.size(), 16, quiet, "charts", [&](std::size_t begin, std::size_t end) {
            for (std::size_t p = begin; p < end; ++p)
                covered[p] = coverTexels(in, places[p]);
        });
    LightmapLayout& layout = atlas.layout;
    layout.instances.resize(scene.instances.size());
    if (done && !places.empty())
        packAtlas(places, layout);
    for (std::size_t p = 0; done && p < places.size(); ++p) {
        writeUv(places[p], in, layout);
        const std::uint32_t instance = places[p].instance;
        for (const LocalTexel& t : covered[p])
            for (std::uint32_t back = 0; back < places[p].sides; ++back) {
                const glm::uvec2 position = glm::uvec2(places[p].offset) + t.position;
                const std::uint32_t y = position.y + back * layout.instances[instance].backRows;
                atlas.texels.push_back({y * layout.width + position.x, instance, back,
                                        1 / (atlas.texelsPerMetre * places[p].factor), t.count,
                                        t.points});
            }
    }
    std::sort(atlas.texels.begin(), atlas.texels.end(),
              [](const AtlasTexel& x, const AtlasTexel& y) { return x.texel < y.texel; });
    layout.meshes = std::move(charts);
    return atlas;
}

Bilinear bilinearAt(const LightmapLayout& layout, glm::vec2 uv) {
    const glm::vec2 p = uv * glm::vec2(float(layout.width), float(layout.height)) - 0.5f;
    const glm::vec2 base = glm::floor(p), f = p - base;
    const auto index = [&](int x, int y) {
        x = std::clamp(x, 0, int(layout.width) - 1);
        y = std::clamp(y, 0, int(layout.height) - 1);
        return std::uint32_t(y) * layout.width + std::uint32_t(x);
    };
    const int x = int(base.x), y = int(base.y);
    return {{index(x, y), index(x + 1, y), index(x, y + 1), index(x + 1, y + 1)},
            {(1 - f.x) * (1 - f.y), f.x * (1 - f.y), (1 - f.x) * f.y, f.x * f.y}};
}

glm::vec2 snappedUv(const LightmapLayout& layout, glm::vec2 base, glm::vec2 f, std::uint32_t snap) {
    if (snap == 1 || snap == 2)
        f.x = float(snap - 1);
    else if (snap == 3 || snap == 4)
        f.y = float(snap - 3);
    else if (snap > 4)
        f = glm::vec2(float((snap - 5) & 1), float((snap - 5) >> 1));
    return (base + f + 0.5f) / glm::vec2(float(layout.width), float(layout.height));
}

AtlasLookup lookupAt(const LightmapLayout& layout, glm::vec2 uv) {
    const glm::vec2 size(float(layout.width), float(layout.height));
    const auto lookup = [&](glm::vec2 p, float width) {
        AtlasLookup l{glm::floor(p), p - glm::floor(p), 0, false, width};
        l.inside = l.base.x >= 0 && l.base.y >= 0 && l.base.x < size.x && l.base.y < size.y;
        if (l.inside && !layout.snaps.empty())
            l.snaps = layout.snaps[std::size_t(l.base.y) * layout.width + std::size_t(l.base.x)];
        return l;
    };
    AtlasLookup l = lookup(uv * size - 0.5f, 1);
    for (int level = 0; level < kFineLevels && (l.snaps & kFineLookup); ++level) {
        const std::uint32_t block = l.snaps & ~kFineLookup;
        l = lookup(glm::vec2(float(block % layout.width), float(block / layout.width)) +
                       l.f * float(kFineCells),
                   l.width / float(kFineCells));
    }
    return l;
}

glm::vec2 snapLookup(const LightmapLayout& layout, glm::vec2 uv) {
    if (layout.snaps.empty())
        return uv;
    const AtlasLookup l = lookupAt(layout, uv);
    if (!l.inside)
        return uv;
    const glm::uvec2 cell = glm::min(glm::uvec2(l.f * float(kSnapCells)), kSnapCells - 1U);
    const bool rows = l.snaps != 0 && !(l.snaps & kFineLookup);
    const std::uint32_t snap = rows ? layout.snaps[l.snaps + cell.y] >> 4 * cell.x & 15U : 0;
    return snappedUv(layout, l.base, l.f, snap);
}

float backOffset(const LightmapLayout& layout, std::uint32_t instance) {
    return float(layout.instances[instance].backRows) / float(layout.height);
}

glm::vec2 unsnappedUv(const LightmapLayout& layout, std::uint32_t instance, std::uint32_t mesh,
                      std::uint32_t triangle, float u, float v, bool back) {
    const std::vector<glm::vec2>& uv = layout.instances[instance].uv;
    const std::vector<std::uint32_t>& indices = layout.meshes[mesh].indices;
    const glm::vec2 front = uv[indices[3 * triangle]] * (1 - u - v) +
                            uv[indices[3 * triangle + 1]] * u + uv[indices[3 * triangle + 2]] * v;
    return {front.x, front.y + (back ? backOffset(layout, instance) : 0.f)};
}

glm::vec2 lightmapUv(const LightmapLayout& layout, std::uint32_t instance, std::uint32_t mesh,
                     std::uint32_t triangle, float u, float v, bool back) {
    return snapLookup(layout, unsnappedUv(layout, instance, mesh, triangle, u, v, back));
}

Bilinear bilinearAt(const LightmapLayout& layout, const Scene& scene, const SurfaceHit& hit) {
    return bilinearAt(layout, lightmapUv(layout, hit.instance, scene.instances[hit.instance].mesh,
                                         hit.triangle, hit.u, hit.v, !hit.frontFace));
}

} // namespace limn
