// SPDX-License-Identifier: MIT
#include "engine/lightmap/texel_cover.h"

#include "engine/math/sampling.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace limn {

namespace {

using Corners = std::array<glm::vec2, 3>;

Corners cornersInPlace(const AtlasInput& in, const ChartPlace& place, std::uint32_t triangle) {
    return {cornerInPlace(in, place, triangle, 0), cornerInPlace(in, place, triangle, 1),
            cornerInPlace(in, place, triangle, 2)};
}

/// True if the open square of half-width 1 around `c`, the reach of a texel's bilinear weight,
/// meets the triangle.
bool reaches(glm::vec2 c, const Corners& t) {
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

/// Calls visit(x, y) for the texels whose bilinear weight is > 0 somewhere on the triangle.
template <class F>
void forReached(const Corners& flat, glm::uvec2 size, F visit) {
    constexpr float kReach = 0.9999f;
    const glm::vec2 low = glm::min(flat[0], glm::min(flat[1], flat[2])) - 0.5f,
                    high = glm::max(flat[0], glm::max(flat[1], flat[2])) - 0.5f;
    const glm::ivec2 last(size - 1U);
    const glm::ivec2 lower = glm::clamp(glm::ivec2(glm::ceil(low - kReach)), glm::ivec2(0), last);
    const glm::ivec2 upper = glm::clamp(glm::ivec2(glm::floor(high + kReach)), glm::ivec2(0), last);
    // A triangle inside a single square between texel centres reads all four of its corners.
    const bool small = glm::all(glm::lessThanEqual(upper - lower, glm::ivec2(1)));
    for (int y = lower.y; y <= upper.y; ++y)
        for (int x = lower.x; x <= upper.x; ++x)
            if (small || reaches({float(x) + 0.5f, float(y) + 0.5f}, flat))
                visit(std::size_t(y) * size.x + std::size_t(x));
}

/// Weights of the triangle's corners at its point closest to `p`.
glm::vec3 closestPoint(glm::vec2 p, const Corners& t) {
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

/// Moves a sample away from the border, where a wall may stand, by up to 0.1 texel towards the
/// triangle's centre.
glm::vec3 pullInside(glm::vec3 weights, const Corners& t) {
    const glm::vec2 p = weights.x * t[0] + weights.y * t[1] + weights.z * t[2];
    const float distance = glm::length((t[0] + t[1] + t[2]) / 3.f - p);
    const float s = std::min(0.25f, distance > 0 ? 0.1f / distance : 0.25f);
    return glm::mix(weights, glm::vec3(1.f / 3), s);
}

/// Samples that a texel has collected while iterating over the triangles.
struct TexelSearch {
    float distance = 1e30f; ///< to the closest surface point, in texels
    MeshPoint closest{};
    std::uint32_t found = 0; ///< points met so far
    std::uint32_t met = 0;   ///< bit k: place k of the lattice lies on the surface
    std::array<MeshPoint, AtlasTexel::kMaxPoints> points;
};

/// Texels of a place that lookups read, with the samples collected so far.
struct Cover {
    glm::uvec2 size;
    std::vector<std::uint32_t> indexOf; ///< per texel of the place: into `found`; ~0: not met
    std::vector<std::uint32_t> texel;
    std::vector<TexelSearch> found;

    explicit Cover(glm::uvec2 s) : size(s), indexOf(std::size_t(s.x) * s.y, ~0U) {}

    TexelSearch& at(std::size_t k) {
        if (indexOf[k] == ~0U) {
            indexOf[k] = std::uint32_t(found.size());
            texel.push_back(std::uint32_t(k));
            found.emplace_back();
        }
        return found[indexOf[k]];
    }
};

glm::vec2 mix3(glm::vec3 w, const Corners& flat) {
    return w.x * flat[0] + w.y * flat[1] + w.z * flat[2];
}

void searchClosest(glm::vec2 centre, std::uint32_t triangle, const Corners& flat,
                   TexelSearch& out) {
    const glm::vec3 w = closestPoint(centre, flat);
    const float d = glm::length(mix3(w, flat) - centre);
    if (d < out.distance) {
        const glm::vec3 inside = pullInside(w, flat);
        out.distance = d;
        out.closest = {triangle, {inside.y, inside.z}};
    }
}

/// Candidate k in a texel, relative to its centre: a rank-1 lattice over [-1/2, 1/2)^2.
glm::vec2 latticeOffset(std::uint32_t k) {
    constexpr float n = float(AtlasTexel::kMaxPoints);
    return {(float(k) + 0.5f) / n - 0.5f,
            (float(3 * k % AtlasTexel::kMaxPoints) + 0.5f) / n - 0.5f};
}

/// Adds the lattice points that lie on the triangle.
void searchLattice(glm::vec2 centre, std::uint32_t triangle, const Corners& flat,
                   TexelSearch& out) {
    const glm::vec2 lower = glm::min(flat[0], glm::min(flat[1], flat[2])),
                    upper = glm::max(flat[0], glm::max(flat[1], flat[2]));
    for (std::uint32_t k = 0; k < AtlasTexel::kMaxPoints; ++k) {
        const glm::vec2 p = centre + latticeOffset(k);
        if (out.met >> k & 1 || glm::any(glm::lessThan(p, lower - 1e-4f)) ||
            glm::any(glm::greaterThan(p, upper + 1e-4f)))
            continue;
        glm::vec3 barycentric = closestPoint(p, flat);
        if (glm::length(mix3(barycentric, flat) - p) > 1e-4f)
            continue;
        if (std::min({barycentric.x, barycentric.y, barycentric.z}) < 0.02f)
            barycentric = pullInside(barycentric, flat);
        out.met |= 1U << k;
        out.points[out.found++] = {triangle, {barycentric.y, barycentric.z}};
    }
}

/// Adds points distributed evenly over the area of all charts, regardless of layers and slopes. Of
/// those inside a texel, seven are kept with equal probability (Vitter. Random Sampling with a
/// Reservoir. 1985).
void sampleByArea(const AtlasInput& in, const ChartPlace& place, Cover& cover) {
    constexpr double kPerTexel = 24, kPerPlace = 8 * AtlasTexel::kMaxPoints;
    const std::uint32_t meshIndex = in.scene.instances[place.instance].mesh;
    const Mesh& mesh = in.scene.assets->meshes[meshIndex];
    double area = 0;
    for (const std::uint32_t c : place.charts)
        for (const std::uint32_t t : in.shapes[meshIndex].trianglesOf(c))
            area += double(triangleArea(mesh, t));
    const double texels = area * double(place.scale.x) * double(place.scale.y);
    const double perArea = std::max(kPerTexel * texels, kPerPlace) / std::max(area, 1e-300);
    double due = 0.5;
    std::uint32_t index = 0;
    std::vector<std::uint32_t> fallen(cover.found.size());
    for (const std::uint32_t c : place.charts)
        for (const std::uint32_t t : in.shapes[meshIndex].trianglesOf(c)) {
            due += double(triangleArea(mesh, t)) * perArea;
            if (due < 1)
                continue;
            const Corners flat = cornersInPlace(in, place, t);
            for (; due >= 1; due -= 1, ++index) {
                const glm::vec2 uv =
                    sampleTriangle({radicalInverse(index + 1, 2), radicalInverse(index + 1, 3)});
                const glm::ivec2 position =
                    glm::clamp(glm::ivec2(glm::floor(mix3({1 - uv.x - uv.y, uv.x, uv.y}, flat))),
                               glm::ivec2(0), glm::ivec2(place.size) - 1);
                const std::uint32_t k =
                    cover.indexOf[std::size_t(position.y) * place.size.x + std::size_t(position.x)];
                if (k == ~0U)
                    continue;
                TexelSearch& texel = cover.found[k];
                const std::uint32_t before = fallen[k]++;
                if (texel.found < AtlasTexel::kMaxPoints)
                    texel.points[texel.found++] = {t, uv};
                else if (const std::uint32_t slot = mixBits(mixBits(before) + k) % (before + 1);
                         slot < AtlasTexel::kMaxPoints)
                    texel.points[slot] = {t, uv};
            }
        }
}

/// Collects the samples on a triangle for all texels that it reaches.
void searchTriangle(std::uint32_t triangle, const Corners& flat, bool lattice, Cover& cover) {
    forReached(flat, cover.size, [&](std::size_t k) {
        const glm::vec2 centre(float(k % cover.size.x) + 0.5f, float(k / cover.size.x) + 0.5f);
        TexelSearch& texel = cover.at(k);
        if (lattice)
            searchLattice(centre, triangle, flat, texel);
        if (texel.found == 0)
            searchClosest(centre, triangle, flat, texel);
    });
}

std::vector<LocalTexel> texelsOf(const Cover& cover) {
    std::vector<LocalTexel> result;
    for (std::size_t i = 0; i < cover.found.size(); ++i) {
        const TexelSearch& f = cover.found[i];
        LocalTexel local{
            {cover.texel[i] % cover.size.x, cover.texel[i] / cover.size.x}, f.found, f.points};
        if (f.found == 0)
            local.points[local.count++] = f.closest;
        result.push_back(local);
    }
    return result;
}

} // namespace

std::uint32_t countTexels(const AtlasInput& in, const ChartPlace& place,
                          std::vector<std::uint8_t>& scratch) {
    if (place.size == glm::uvec2(1))
        return 1;
    scratch.assign(std::size_t(place.size.x) * place.size.y, 0);
    const MeshChartShapes& shapes = in.shapes[in.scene.instances[place.instance].mesh];
    for (const std::uint32_t c : place.charts)
        for (const std::uint32_t t : shapes.trianglesOf(c))
            forReached(cornersInPlace(in, place, t), place.size,
                       [&](std::size_t k) { scratch[k] = 1; });
    return std::uint32_t(std::count(scratch.begin(), scratch.end(), 1));
}

std::vector<LocalTexel> coverTriangles(const std::vector<FlatTriangle>& triangles,
                                       glm::uvec2 size) {
    Cover cover(size);
    for (const FlatTriangle& t : triangles)
        searchTriangle(t.triangle, t.corner, true, cover);
    return texelsOf(cover);
}

std::vector<LocalTexel> coverTexels(const AtlasInput& in, const ChartPlace& place) {
    Cover cover(place.size);
    const MeshChartShapes& shapes = in.shapes[in.scene.instances[place.instance].mesh];
    const bool layered = place.axis >= 0 || place.size == glm::uvec2(1);
    for (const std::uint32_t c : place.charts)
        for (const std::uint32_t t : shapes.trianglesOf(c))
            searchTriangle(t, cornersInPlace(in, place, t), !layered, cover);
    if (layered)
        sampleByArea(in, place, cover);
    return texelsOf(cover);
}

} // namespace limn
