// SPDX-License-Identifier: MIT
#include "engine/bake/atlas.h"

#include "engine/core/parallel.h"
#include "engine/scene/triangle_geometry.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <tuple>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stb/stb_rect_pack.h>

namespace limn {

namespace {

/// Triangles of one mesh, chart by chart.
struct ChartTriangles {
    std::vector<std::uint32_t> begin, triangles;

    std::span<const std::uint32_t> of(std::uint32_t chart) const {
        return {triangles.data() + begin[chart], begin[chart + 1] - begin[chart]};
    }
};

ChartTriangles trianglesByChart(const MeshCharts& charts) {
    ChartTriangles result;
    result.begin.assign(charts.chartSize.size() + 1, 0);
    for (const std::uint32_t c : charts.chartOfTriangle)
        ++result.begin[c + 1];
    std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
    result.triangles.resize(charts.chartOfTriangle.size());
    std::vector<std::uint32_t> next(result.begin.begin(), result.begin.end() - 1);
    for (std::uint32_t t = 0; t < charts.chartOfTriangle.size(); ++t)
        result.triangles[next[charts.chartOfTriangle[t]]++] = t;
    return result;
}

/// One chart of one instance: its size in texels, and how plane coordinates become texel
/// coordinates.
struct Place {
    std::uint32_t instance, chart;
    glm::uvec2 size{1};
    glm::vec2 scale{0}; ///< texels per object unit; 0 along a side of one texel
    glm::ivec2 offset{0};

    glm::vec2 toTexels(glm::vec2 chartUv) const { return chartUv * scale + 0.5f; }
};

/// A texel of a place, with the surface points it stands for.
struct LocalTexel {
    glm::uvec2 at;
    std::uint32_t count;
    std::array<MeshPoint, AtlasTexel::kMostPoints> points;
};

std::uint32_t sideTexels(float texels) {
    constexpr float kLargestSide = 8192;
    return texels < 0.5f ? 1U : std::uint32_t(std::lround(std::min(texels, kLargestSide))) + 1;
}

Place makePlace(std::uint32_t instance, std::uint32_t chart, glm::vec2 size, float texelsPerUnit) {
    Place place{instance, chart, {}, {}, {}};
    for (int k = 0; k < 2; ++k) {
        place.size[k] = std::max(1U, sideTexels(size[k] * texelsPerUnit));
        place.scale[k] = place.size[k] > 1 ? float(place.size[k] - 1) / size[k] : 0;
    }
    return place;
}

/// True if the open square of half-width 1 around `c`, the reach of a texel's bilinear weight,
/// meets the triangle.
bool reaches(glm::vec2 c, const std::array<glm::vec2, 3>& t) {
    constexpr float kHalf = 0.9999f;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec2 e = t[(i + 1) % 3] - t[i], axis{-e.y, e.x};
        const float a = glm::dot(axis, t[i]), b = glm::dot(axis, t[(i + 2) % 3]),
                    p = glm::dot(axis, c);
        const float reach = kHalf * (std::abs(axis.x) + std::abs(axis.y));
        if (p + reach < std::min(a, b) || p - reach > std::max(a, b))
            return false;
    }
    const glm::vec2 lower = glm::min(t[0], glm::min(t[1], t[2])),
                    upper = glm::max(t[0], glm::max(t[1], t[2]));
    return glm::all(glm::lessThanEqual(lower, c + kHalf)) &&
           glm::all(glm::greaterThanEqual(upper, c - kHalf));
}

/// Weights of the triangle's corners at its point closest to `p`.
glm::vec3 closestPoint(glm::vec2 p, const std::array<glm::vec2, 3>& t) {
    const auto cross2 = [](glm::vec2 a, glm::vec2 b) { return a.x * b.y - a.y * b.x; };
    const float area = cross2(t[1] - t[0], t[2] - t[0]);
    if (std::abs(area) > 1e-12f) {
        const glm::vec3 w = glm::vec3(cross2(t[1] - p, t[2] - p), cross2(t[2] - p, t[0] - p),
                                      cross2(t[0] - p, t[1] - p)) /
                            area;
        if (w.x >= 0 && w.y >= 0 && w.z >= 0)
            return w;
    }
    glm::vec3 best{1, 0, 0};
    float bestDistance = 1e30f;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const glm::vec2 a = t[std::size_t(i)], edge = t[std::size_t(j)] - a;
        const float length2 = glm::dot(edge, edge);
        const float s = length2 > 0 ? glm::clamp(glm::dot(p - a, edge) / length2, 0.f, 1.f) : 0.f;
        const glm::vec2 d = p - (a + s * edge);
        if (glm::dot(d, d) < bestDistance) {
            bestDistance = glm::dot(d, d);
            best = glm::vec3(0);
            best[i] = 1 - s;
            best[j] = s;
        }
    }
    return best;
}

/// Keeps a sample off the very border, where a wall may stand: up to 0.1 texel towards the
/// triangle's middle.
glm::vec3 pullInside(glm::vec3 weights, const std::array<glm::vec2, 3>& t) {
    const glm::vec2 p = weights.x * t[0] + weights.y * t[1] + weights.z * t[2];
    const float distance = glm::length((t[0] + t[1] + t[2]) / 3.f - p);
    const float s = std::min(0.25f, distance > 0 ? 0.1f / distance : 0.25f);
    return glm::mix(weights, glm::vec3(1.f / 3), s);
}

/// What a texel has found while the triangles pass by.
struct TexelSearch {
    float distance =
        1e30f; ///< to the closest surface point, in texels; 1e30: out of every lookup's reach
    MeshPoint closest{};
    std::uint32_t found = 0; ///< bit k: spread[k] lies on the surface
    std::array<MeshPoint, AtlasTexel::kMostPoints> spread;
};

/// The k-th of the places looked for in a texel, relative to its centre: a rank-1 lattice over
/// [-1/2, 1/2)^2.
glm::vec2 spreadOffset(std::uint32_t k) {
    constexpr float n = float(AtlasTexel::kMostPoints);
    return {(float(k) + 0.5f) / n - 0.5f,
            (float(3 * k % AtlasTexel::kMostPoints) + 0.5f) / n - 0.5f};
}

void searchTexel(glm::vec2 centre, std::uint32_t triangle, const std::array<glm::vec2, 3>& flat,
                 bool spread, TexelSearch& out) {
    const glm::vec3 w = closestPoint(centre, flat);
    const float d = glm::length(w.x * flat[0] + w.y * flat[1] + w.z * flat[2] - centre);
    if (d < out.distance) {
        const glm::vec3 inside = pullInside(w, flat);
        out.distance = d;
        out.closest = {triangle, {inside.y, inside.z}};
    }
    for (std::uint32_t k = 0; spread && k < AtlasTexel::kMostPoints; ++k) {
        if (out.found >> k & 1)
            continue;
        const glm::vec2 p = centre + spreadOffset(k);
        glm::vec3 at = closestPoint(p, flat);
        if (glm::length(at.x * flat[0] + at.y * flat[1] + at.z * flat[2] - p) > 1e-4f)
            continue;
        if (std::min({at.x, at.y, at.z}) < 0.02f)
            at = pullInside(at, flat);
        out.found |= 1U << k;
        out.spread[k] = {triangle, {at.y, at.z}};
    }
}

LocalTexel localTexel(glm::uvec2 at, const TexelSearch& search) {
    LocalTexel result{at, 0, {}};
    for (std::uint32_t k = 0; k < AtlasTexel::kMostPoints; ++k)
        if (search.found >> k & 1)
            result.points[result.count++] = search.spread[k];
    if (result.count == 0)
        result.points[result.count++] = search.closest;
    return result;
}

/// Texels of `place` that a lookup on its triangles can meet. Without `spread` only the closest
/// points are looked for.
std::vector<LocalTexel> coverTexels(const Place& place, const MeshCharts& charts,
                                    std::span<const std::uint32_t> triangles, bool spread) {
    std::vector<TexelSearch> search(std::size_t(place.size.x) * place.size.y);
    for (const std::uint32_t t : triangles) {
        std::array<glm::vec2, 3> flat;
        for (std::size_t k = 0; k < 3; ++k)
            flat[k] = place.toTexels(charts.chartUv[charts.indices[3 * t + k]]);
        const glm::ivec2 last(place.size - 1U);
        const glm::ivec2 lower =
            glm::clamp(glm::ivec2(glm::floor(glm::min(flat[0], glm::min(flat[1], flat[2])) - 1.5f)),
                       glm::ivec2(0), last);
        const glm::ivec2 upper =
            glm::clamp(glm::ivec2(glm::ceil(glm::max(flat[0], glm::max(flat[1], flat[2])) + 0.5f)),
                       glm::ivec2(0), last);
        for (int y = lower.y; y <= upper.y; ++y)
            for (int x = lower.x; x <= upper.x; ++x) {
                const glm::vec2 centre(float(x) + 0.5f, float(y) + 0.5f);
                if (reaches(centre, flat))
                    searchTexel(centre, t, flat, spread,
                                search[std::size_t(y) * place.size.x + std::size_t(x)]);
            }
    }
    std::vector<LocalTexel> result;
    for (std::uint32_t i = 0; i < search.size(); ++i)
        if (search[i].distance < 1e30f)
            result.push_back(localTexel({i % place.size.x, i / place.size.x}, search[i]));
    return result;
}

/// Everything one density needs; made anew for each density tried.
struct Arrangement {
    std::vector<Place> places;                    ///< charts with texels of their own
    std::vector<std::vector<LocalTexel>> covered; ///< per place
    std::vector<std::vector<Place>> shared;       ///< groups of tiny charts, one texel each
    std::size_t texelCount() const {
        std::size_t count = shared.size();
        for (const auto& c : covered)
            count += c.size();
        return count;
    }
};

struct AtlasInput {
    const Scene& scene;
    const std::vector<MeshCharts>& charts;
    std::vector<ChartTriangles> byChart;
    std::vector<float> scale; ///< per instance: atlasScale
    Progress progress;        ///< only its cancellation is used
};

bool hasLightmap(const AtlasInput& in, const Instance& instance) {
    return !instance.dynamic && !in.charts[instance.mesh].indices.empty();
}

/// Which tiny charts share a texel: those in the same cell of a grid of one texel over the mesh,
/// facing the same way.
using ShareKey = std::tuple<std::uint32_t, int, int, int, int>;

ShareKey shareKey(const AtlasInput& in, const Place& place, float texelsPerUnit) {
    const std::uint32_t meshIndex = in.scene.instances[place.instance].mesh;
    const Mesh& mesh = in.scene.assets->meshes[meshIndex];
    const std::uint32_t triangle = in.byChart[meshIndex].of(place.chart)[0];
    const glm::vec3 n = triangleNormal(mesh, triangle), size = glm::abs(n);
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const glm::vec3 p = mesh.positions[mesh.triangle(triangle)[0]];
    const glm::ivec3 cell(glm::floor(p * texelsPerUnit));
    return {place.instance, cell.x, cell.y, cell.z, axis * 2 + (n[axis] < 0 ? 1 : 0)};
}

Arrangement arrange(const AtlasInput& in, float density, bool spread) {
    Arrangement result;
    std::map<ShareKey, std::uint32_t> groups;
    for (std::uint32_t i = 0; i < in.scene.instances.size(); ++i) {
        const Instance& instance = in.scene.instances[i];
        if (!hasLightmap(in, instance))
            continue;
        const MeshCharts& charts = in.charts[instance.mesh];
        const float texelsPerUnit = density * in.scale[i];
        for (std::uint32_t c = 0; c < charts.chartSize.size(); ++c) {
            const Place place = makePlace(i, c, charts.chartSize[c], texelsPerUnit);
            if (place.size.x > 1 || place.size.y > 1) {
                result.places.push_back(place);
                continue;
            }
            const auto [it, fresh] = groups.try_emplace(shareKey(in, place, texelsPerUnit),
                                                        std::uint32_t(result.shared.size()));
            if (fresh)
                result.shared.emplace_back();
            result.shared[it->second].push_back(place);
        }
    }
    result.covered.resize(result.places.size());
    const auto cover = [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            const std::uint32_t mesh = in.scene.instances[result.places[p].instance].mesh;
            result.covered[p] = coverTexels(result.places[p], in.charts[mesh],
                                            in.byChart[mesh].of(result.places[p].chart), spread);
        }
    };
    parallelRanges(result.places.size(), 16, in.progress, "charts", cover);
    return result;
}

/// Summed area [m^2], from the scales that the charts get.
double lightmappedArea(const AtlasInput& in) {
    std::vector<double> area(in.charts.size(), -1);
    double sum = 0;
    for (std::size_t i = 0; i < in.scene.instances.size(); ++i) {
        const Instance& instance = in.scene.instances[i];
        if (!hasLightmap(in, instance))
            continue;
        double& mesh = area[instance.mesh];
        if (mesh < 0) {
            mesh = 0;
            for (std::size_t t = 0; t < in.scene.meshOf(instance).triangleCount(); ++t)
                mesh += double(triangleArea(in.scene.meshOf(instance), t));
        }
        sum += mesh * double(in.scale[i]) * double(in.scale[i]);
    }
    return sum;
}

/// The density in texels per metre whose texel count is nearest below `wanted`, by bisection over
/// 2^(k / 256), k whole: small changes of a scene leave its density and so its texels alone.
float findDensity(const AtlasInput& in, std::uint32_t wanted) {
    const double area = lightmappedArea(in);
    if (!(area > 0))
        return 1;
    constexpr int kSteps = 256; // per octave
    const auto density = [](int k) { return float(std::exp2(double(k) / kSteps)); };
    const int middle = int(std::floor(std::log2(wanted / area) / 2 * kSteps));
    int low = middle - 6 * kSteps, high = middle + kSteps;
    while (high - low > 1 && !in.progress.cancelled()) {
        const int k = low + (high - low) / 2;
        (arrange(in, density(k), false).texelCount() > wanted ? high : low) = k;
    }
    return density(low);
}

/// Packs the places; sets their offsets and the atlas size. Returns which texels are taken.
std::vector<bool> packPlaces(std::vector<Place>& places, std::size_t singles,
                             LightmapLayout& layout) {
    std::vector<stbrp_rect> rects;
    std::uint64_t area = singles;
    std::uint32_t widest = 1, tallestSum = 1;
    for (std::size_t i = 0; i < places.size(); ++i) {
        rects.push_back({int(i), int(places[i].size.x), int(places[i].size.y), 0, 0, 0});
        area += std::uint64_t(places[i].size.x) * places[i].size.y;
        widest = std::max(widest, places[i].size.x);
        tallestSum += places[i].size.y;
    }
    layout.width = std::max(widest, std::uint32_t(std::ceil(std::sqrt(double(area) * 1.1))));
    std::vector<stbrp_node> nodes(layout.width);
    stbrp_context context;
    stbrp_init_target(&context, int(layout.width), int(std::min(tallestSum, 1U << 30)),
                      nodes.data(), int(nodes.size()));
    stbrp_pack_rects(&context, rects.data(), int(rects.size()));
    layout.height = 1;
    for (const stbrp_rect& r : rects) {
        assert(r.was_packed);
        places[std::size_t(r.id)].offset = {r.x, r.y};
        layout.height = std::max(layout.height, std::uint32_t(r.y + r.h));
    }
    std::vector<bool> taken(std::size_t(layout.width) * layout.height);
    for (const Place& p : places)
        for (std::uint32_t y = 0; y < p.size.y; ++y)
            for (std::uint32_t x = 0; x < p.size.x; ++x)
                taken[(std::size_t(p.offset.y) + y) * layout.width + std::size_t(p.offset.x) + x] =
                    true;
    return taken;
}

/// Puts each group of tiny charts on a free texel; adds rows where none is left.
void placeShared(Arrangement& a, std::vector<bool>& taken, LightmapLayout& layout) {
    std::size_t next = 0;
    for (std::vector<Place>& group : a.shared) {
        while (next < taken.size() && taken[next])
            ++next;
        if (next == taken.size()) {
            taken.resize(taken.size() + layout.width);
            ++layout.height;
        }
        for (Place& place : group)
            place.offset = {int(next % layout.width), int(next / layout.width)};
        taken[next] = true;
    }
}

void writeUv(const Place& place, const AtlasInput& in, LightmapLayout& layout) {
    const std::uint32_t mesh = in.scene.instances[place.instance].mesh;
    const MeshCharts& charts = in.charts[mesh];
    std::vector<glm::vec2>& uv = layout.instances[place.instance].uv;
    uv.resize(charts.sourceVertex.size());
    const glm::vec2 size(float(layout.width), float(layout.height));
    for (const std::uint32_t t : in.byChart[mesh].of(place.chart))
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = charts.indices[3 * t + k];
            uv[vertex] = (glm::vec2(place.offset) + place.toTexels(charts.chartUv[vertex])) / size;
        }
}

/// The surface points a shared texel stands for: the middles of the group's largest triangles.
AtlasTexel sharedTexel(const std::vector<Place>& group, const AtlasInput& in, std::uint32_t width) {
    AtlasTexel result;
    result.texel = std::uint32_t(group[0].offset.y) * width + std::uint32_t(group[0].offset.x);
    result.instance = group[0].instance;
    const std::uint32_t meshIndex = in.scene.instances[result.instance].mesh;
    const Mesh& mesh = in.scene.assets->meshes[meshIndex];
    std::vector<std::pair<float, std::uint32_t>> largest; // by falling area, then index
    for (const Place& place : group)
        for (const std::uint32_t t : in.byChart[meshIndex].of(place.chart))
            largest.emplace_back(-triangleArea(mesh, t), t);
    std::sort(largest.begin(), largest.end());
    for (; result.count < std::min<std::size_t>(AtlasTexel::kMostPoints, largest.size());
         ++result.count)
        result.points[result.count] = {largest[result.count].second, glm::vec2(1.f / 3)};
    return result;
}

} // namespace

float atlasScale(const Instance& instance) {
    const float scale = std::cbrt(std::abs(glm::determinant(glm::mat3(instance.toWorld))));
    int exponent;
    const float mantissa = std::frexp(scale, &exponent);
    constexpr float kSteps = 4096; // hides what a rotation's rounding does to the determinant
    return std::isfinite(scale) ? std::ldexp(std::round(mantissa * kSteps) / kSteps, exponent) : 0;
}

Atlas buildAtlas(const Scene& scene, std::vector<MeshCharts> charts, const BakeSettings& settings,
                 const Progress& progress) {
    AtlasInput in{scene, charts, {}, {}, {.report = {}, .cancel = progress.cancel}};
    for (const Instance& i : scene.instances)
        in.scale.push_back(atlasScale(i));
    for (const MeshCharts& c : charts)
        in.byChart.push_back(trianglesByChart(c));
    Atlas atlas;
    atlas.texelsPerMetre = settings.texelsPerMetre > 0 ? settings.texelsPerMetre
                                                       : findDensity(in, settings.lightmapCaches);
    Arrangement a = arrange(in, atlas.texelsPerMetre, true);
    if (progress.cancelled())
        return atlas;
    LightmapLayout& layout = atlas.layout;
    layout.instances.resize(scene.instances.size());
    if (a.texelCount() == 0) {
        layout.meshes = std::move(charts);
        return atlas;
    }
    std::vector<bool> taken = packPlaces(a.places, a.shared.size(), layout);
    placeShared(a, taken, layout);
    for (std::size_t p = 0; p < a.places.size(); ++p) {
        const Place& place = a.places[p];
        writeUv(place, in, layout);
        for (const LocalTexel& t : a.covered[p]) {
            const glm::uvec2 at = glm::uvec2(place.offset) + t.at;
            atlas.texels.push_back({at.y * layout.width + at.x, place.instance, t.count, t.points});
        }
    }
    for (const std::vector<Place>& group : a.shared) {
        for (const Place& place : group)
            writeUv(place, in, layout);
        atlas.texels.push_back(sharedTexel(group, in, layout.width));
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

glm::vec2 lightmapUv(const LightmapLayout& layout, std::uint32_t instance, std::uint32_t mesh,
                     std::uint32_t triangle, float u, float v) {
    const std::vector<glm::vec2>& uv = layout.instances[instance].uv;
    const std::vector<std::uint32_t>& indices = layout.meshes[mesh].indices;
    return uv[indices[3 * triangle]] * (1 - u - v) + uv[indices[3 * triangle + 1]] * u +
           uv[indices[3 * triangle + 2]] * v;
}

} // namespace limn
