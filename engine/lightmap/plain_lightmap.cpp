// SPDX-License-Identifier: MIT
#include "engine/lightmap/plain_lightmap.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/atlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

/// Weights up to this are roundings at the border of a chart, beyond which lies another's texel.
constexpr float kRounding = 1e-4f;

/// A triangle of one side of an instance, in texels of some lightmap.
struct SideTriangle {
    std::array<glm::vec2, 3> corner;
    std::uint32_t instance, triangle;
    bool back;
};

/// The closest point of a triangle in the plane, as barycentrics.
struct Closest {
    float u, v, distance2;
};

Closest closestOnEdge(const SideTriangle& t, std::size_t from, std::size_t to, glm::vec2 p) {
    const glm::vec2 edge = t.corner[to] - t.corner[from], d = p - t.corner[from];
    const float length2 = glm::dot(edge, edge);
    const float s = length2 > 0 ? std::clamp(glm::dot(d, edge) / length2, 0.f, 1.f) : 0.f;
    const glm::vec2 off = d - edge * s;
    std::array<float, 3> weight{};
    weight[from] = 1 - s;
    weight[to] += s;
    return {weight[1], weight[2], glm::dot(off, off)};
}

Closest closestPoint(const SideTriangle& t, glm::vec2 p) {
    const glm::vec2 a = t.corner[1] - t.corner[0], b = t.corner[2] - t.corner[0],
                    d = p - t.corner[0];
    const float area = a.x * b.y - a.y * b.x;
    if (area != 0) {
        const float u = (d.x * b.y - d.y * b.x) / area, v = (a.x * d.y - a.y * d.x) / area;
        if (u >= 0 && v >= 0 && u + v <= 1)
            return {u, v, 0};
    }
    Closest best = closestOnEdge(t, 0, 1, p);
    for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>(1, 2), {2, 0}})
        if (const Closest next = closestOnEdge(t, from, to, p); next.distance2 < best.distance2)
            best = next;
    return best;
}

/// Calls visit(triangle, chart) for every triangle that has a lightmap, on each of its sides.
/// Charts are counted over all instances and sides.
template <class Visit>
void forEachTriangle(const Scene& scene, const LightmapLayout& layout, glm::uvec2 size,
                     const Visit& visit) {
    std::uint32_t firstChart = 0;
    for (std::uint32_t i = 0; i < scene.instances.size() && i < layout.instances.size(); ++i) {
        const InstanceLightmap& place = layout.instances[i];
        if (place.uv.empty())
            continue;
        const MeshCharts& charts = layout.meshes[scene.instances[i].mesh];
        for (const bool back : {false, true}) {
            if (back && place.backRows == 0)
                continue;
            const glm::vec2 offset(0, back ? backOffset(layout, i) : 0.f);
            for (std::uint32_t t = 0; t < charts.chartOfTriangle.size(); ++t) {
                SideTriangle flat{.instance = i, .triangle = t, .back = back};
                for (std::size_t k = 0; k < 3; ++k)
                    flat.corner[k] =
                        (place.uv[charts.indices[3 * t + k]] + offset) * glm::vec2(size);
                visit(flat, firstChart + charts.chartOfTriangle[t]);
            }
            firstChart += std::uint32_t(charts.chartSize.size());
        }
    }
}

/// Whether a bilinear lookup somewhere in the triangle reads the texel centred at `c`: whether the
/// triangle meets the square of two texels a side around it. Two convex shapes are apart where
/// their projections along the normal of one of their edges are.
bool reads(const SideTriangle& t, glm::vec2 c) {
    const auto apart = [&](glm::vec2 axis) {
        const float a = glm::dot(t.corner[0] - c, axis), b = glm::dot(t.corner[1] - c, axis),
                    d = glm::dot(t.corner[2] - c, axis);
        const float reach = (1 - kRounding) * (std::abs(axis.x) + std::abs(axis.y));
        return std::min({a, b, d}) > reach || std::max({a, b, d}) < -reach;
    };
    if (apart({1, 0}) || apart({0, 1}))
        return false;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec2 edge = t.corner[(k + 1) % 3] - t.corner[k];
        if (apart({-edge.y, edge.x}))
            return false;
    }
    return true;
}

/// Calls visit(texel, closest point) for every texel that a bilinear lookup somewhere in the
/// triangle reads.
template <class Visit>
void forEachTexel(const SideTriangle& t, glm::uvec2 size, const Visit& visit) {
    const glm::vec2 lower = glm::min(glm::min(t.corner[0], t.corner[1]), t.corner[2]);
    const glm::vec2 upper = glm::max(glm::max(t.corner[0], t.corner[1]), t.corner[2]);
    const glm::ivec2 last = glm::ivec2(size) - 1;
    const glm::ivec2 begin = glm::clamp(glm::ivec2(glm::floor(lower - 0.5f)), glm::ivec2(0), last);
    const glm::ivec2 end = glm::clamp(glm::ivec2(glm::ceil(upper - 0.5f)), glm::ivec2(0), last);
    for (int y = begin.y; y <= end.y; ++y)
        for (int x = begin.x; x <= end.x; ++x) {
            const glm::vec2 centre = glm::vec2(x, y) + 0.5f;
            if (reads(t, centre))
                visit(std::uint32_t(y) * size.x + std::uint32_t(x), closestPoint(t, centre));
        }
}

/// The surface point of each texel: of the triangle that is closest to its centre.
struct Claims {
    std::vector<PlainTexel> texels;
    std::vector<std::uint32_t> chart, texelAt;
    std::vector<float> distance2; ///< from the texel's centre, in texels, squared
};

Claims claimTexels(const Scene& scene, const LightmapLayout& layout, glm::uvec2 size) {
    Claims claims;
    claims.texelAt.assign(std::size_t(size.x) * size.y, kNoTexel);
    forEachTriangle(scene, layout, size, [&](const SideTriangle& t, std::uint32_t chart) {
        forEachTexel(t, size, [&](std::uint32_t place, const Closest& near) {
            std::uint32_t& index = claims.texelAt[place];
            if (index == kNoTexel) {
                index = std::uint32_t(claims.texels.size());
                claims.texels.emplace_back();
                claims.chart.push_back(chart);
                claims.distance2.push_back(std::numeric_limits<float>::infinity());
            }
            if (near.distance2 < claims.distance2[index]) {
                claims.distance2[index] = near.distance2;
                claims.chart[index] = chart;
                claims.texels[index] = {.instance = t.instance,
                                        .triangle = t.triangle,
                                        .u = near.u,
                                        .v = near.v,
                                        .back = t.back};
            }
        });
    });
    return claims;
}

/// Whether a lookup at `uv` reads texels of that chart alone.
bool readsOnly(const LightmapLayout& layout, const Claims& layoutClaims, glm::vec2 uv,
               std::uint32_t chart) {
    const Bilinear lookup = bilinearAt(layout, uv);
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t index = layoutClaims.texelAt[lookup.texel[k]];
        if (lookup.weight[k] > kRounding &&
            (index == kNoTexel || layoutClaims.chart[index] != chart))
            return false;
    }
    return true;
}

} // namespace

void repeatNearest(std::vector<std::uint32_t>& texelAt, glm::uvec2 size) {
    std::vector<std::uint32_t> front, next;
    for (std::uint32_t place = 0; place < texelAt.size(); ++place)
        if (texelAt[place] != kNoTexel)
            front.push_back(place);
    while (!front.empty()) {
        next.clear();
        for (const std::uint32_t place : front) {
            const std::uint32_t x = place % size.x, y = place / size.x;
            const auto give = [&](bool inside, std::uint32_t to) {
                if (!inside || texelAt[to] != kNoTexel)
                    return;
                texelAt[to] = texelAt[place];
                next.push_back(to);
            };
            give(x > 0, place - 1);
            give(x + 1 < size.x, place + 1);
            give(y > 0, place - size.x);
            give(y + 1 < size.y, place + size.x);
        }
        std::swap(front, next);
    }
}

PlainLightmap plainLightmap(const Scene& scene, const LightmapLayout& layout,
                            std::uint32_t factor) {
    const glm::uvec2 size(layout.width * factor, layout.height * factor);
    // With snaps, only the lookups of surface points are known to read texels that hold light.
    Claims layoutClaims;
    if (layout.snaps.empty())
        layoutClaims = claimTexels(scene, layout, {layout.width, layout.height});
    Claims claims = claimTexels(scene, layout, size);
    if (claims.texels.empty())
        return {};
    std::vector<std::uint32_t> placeOf(claims.texels.size());
    for (std::uint32_t place = 0; place < claims.texelAt.size(); ++place)
        if (claims.texelAt[place] != kNoTexel)
            placeOf[claims.texelAt[place]] = place;
    parallelRanges(claims.texels.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            PlainTexel& texel = claims.texels[i];
            const glm::uvec2 position(placeOf[i] % size.x, placeOf[i] / size.x);
            glm::vec2 uv = (glm::vec2(position) + 0.5f) / glm::vec2(size);
            const bool mayLookUp =
                claims.distance2[i] == 0 ||
                (layout.snaps.empty() && readsOnly(layout, layoutClaims, uv, claims.chart[i]));
            if (!mayLookUp)
                uv = unsnappedUv(layout, texel.instance, scene.instances[texel.instance].mesh,
                                 texel.triangle, texel.u, texel.v, texel.back);
            const Bilinear lookup = bilinearAt(layout, snapLookup(layout, uv));
            for (int k = 0; k < 4; ++k) {
                texel.texel[k] = lookup.texel[k];
                texel.weight[k] = lookup.weight[k] > kRounding ? lookup.weight[k] : 0;
            }
            texel.weight /= glm::dot(texel.weight, glm::vec4(1));
        }
    });
    repeatNearest(claims.texelAt, size);
    return {.width = size.x,
            .height = size.y,
            .texels = std::move(claims.texels),
            .texelAt = std::move(claims.texelAt)};
}

} // namespace limn
