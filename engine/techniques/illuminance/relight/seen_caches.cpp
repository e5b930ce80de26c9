// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/seen_caches.h"

#include "engine/core/parallel.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace limn {

namespace {

constexpr float kBeyond = 1.f / 256; ///< [texels]; filters round weights to 8 bits
constexpr float kWider = 1.02f;      ///< smaller pictures have another aspect, due to rounding

/// Sine of the angle by which a triangle of a few pixels may rotate when its corners are rounded to
/// subpixel positions.
constexpr float kEdgeOn = 0.02f;

/// A corner of a triangle: its lookup in the lightmap, in texels from the first one's centre, and
/// its world position.
struct Corner {
    glm::vec2 texel;
    glm::vec3 position;
};

/// A triangle clipped by four lines. It has at most seven corners, or 13 where rounding dents it.
struct Polygon {
    std::array<Corner, 13> corners;
    std::size_t count = 0;
};

/// The part where sign * texel[axis] <= limit.
Polygon cut(const Polygon& from, int axis, float sign, float limit) {
    Polygon to;
    for (std::size_t i = 0; i < from.count; ++i) {
        const Corner &a = from.corners[i], &b = from.corners[(i + 1) % from.count];
        const float da = sign * a.texel[axis] - limit, db = sign * b.texel[axis] - limit;
        if (da <= 0)
            to.corners[to.count++] = a;
        if ((da <= 0) != (db <= 0)) {
            const float t = da / (da - db);
            to.corners[to.count++] = {glm::mix(a.texel, b.texel, t),
                                      glm::mix(a.position, b.position, t)};
        }
    }
    return to;
}

/// The part within the reach of the bilinear weight of `texel`; lookups beyond the atlas are those
/// at its border.
Polygon cutToReach(Polygon p, glm::ivec2 texel, glm::ivec2 size) {
    constexpr float kReach = 1 + kBeyond;
    for (int axis = 0; axis < 2; ++axis) {
        if (texel[axis] > 0)
            p = cut(p, axis, -1, kReach - float(texel[axis]));
        if (texel[axis] < size[axis] - 1)
            p = cut(p, axis, 1, kReach + float(texel[axis]));
    }
    return p;
}

void add(CacheFootprint& to, const Polygon& p, glm::vec3 normal) {
    const bool first = isEmpty(to.bounds);
    for (std::size_t i = 0; i < p.count; ++i)
        extend(to.bounds, p.corners[i].position);
    if (first)
        to.normal = normal;
    to.cosSpread = std::min(to.cosSpread, glm::dot(to.normal, normal));
    if (to.cosSpread < 0.01f) // normals over half of all directions: it may be seen from anywhere
        to.normal = glm::vec3(0), to.cosSpread = 1;
}

struct TexelFootprint {
    std::uint32_t texel;
    CacheFootprint footprint;
};

/// Triangles of a mesh in the order of their charts.
std::vector<std::uint32_t> byChart(const MeshCharts& charts) {
    std::vector<std::uint32_t> triangles(charts.chartOfTriangle.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        triangles[t] = t;
    std::ranges::stable_sort(triangles, {},
                             [&](std::uint32_t t) { return charts.chartOfTriangle[t]; });
    return triangles;
}

struct InstanceLookup {
    const Scene& scene;
    const LightmapLayout& layout;
    std::uint32_t index;
    bool back; ///< of a two-sided instance

    const Instance& instance() const { return scene.instances[index]; }

    Polygon triangle(std::uint32_t t) const {
        const MeshCharts& charts = layout.meshes[instance().mesh];
        const Mesh& mesh = scene.meshOf(instance());
        const glm::vec2 size(float(layout.width), float(layout.height));
        const glm::vec2 first(-0.5f, back ? float(layout.instances[index].backRows) - 0.5f : -0.5f);
        Polygon p{.count = 3};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = charts.indices[3 * t + k];
            p.corners[k] = {layout.instances[index].uv[v] * size + first,
                            glm::vec3(instance().toWorld *
                                      glm::vec4(mesh.positions[charts.sourceVertex[v]], 1))};
        }
        return p;
    }

    /// Normal on the side that is looked up.
    glm::vec3 normal(std::uint32_t t) const {
        const Instance& i = instance();
        const glm::vec3 n = i.normalToWorld * triangleNormal(scene.meshOf(i), t);
        const float length = glm::length(n);
        return length > 0 ? (back ? -n : n) / length : glm::vec3(0);
    }
};

/// Box of the texels that a polygon looks up: the first and the last one.
struct TexelBox {
    glm::ivec2 lower, upper;
};

TexelBox texelsOf(const Polygon& p, glm::ivec2 size) {
    glm::vec2 low = p.corners[0].texel, high = low;
    for (std::size_t i = 1; i < p.count; ++i) {
        low = glm::min(low, p.corners[i].texel);
        high = glm::max(high, p.corners[i].texel);
    }
    return {glm::clamp(glm::ivec2(glm::ceil(low - 1.f - kBeyond)), glm::ivec2(0), size - 1),
            glm::clamp(glm::ivec2(glm::floor(high + 1.f + kBeyond)), glm::ivec2(0), size - 1)};
}

/// Adds the footprints of the triangles of one chart.
void addChart(const InstanceLookup& in, std::span<const std::uint32_t> triangles,
              std::vector<std::int32_t>& indexOf, std::vector<TexelFootprint>& out) {
    const glm::ivec2 size(int(in.layout.width), int(in.layout.height));
    TexelBox box{size, glm::ivec2(-1)};
    for (const std::uint32_t t : triangles) {
        const TexelBox b = texelsOf(in.triangle(t), size);
        box = {glm::min(box.lower, b.lower), glm::max(box.upper, b.upper)};
    }
    const glm::ivec2 extent = box.upper - box.lower + 1;
    indexOf.assign(std::size_t(extent.x) * std::size_t(extent.y), -1);
    for (const std::uint32_t t : triangles) {
        const Polygon whole = in.triangle(t);
        const glm::vec3 normal = in.normal(t);
        const TexelBox b = texelsOf(whole, size);
        // The triangle is smaller than a texel, so clipping would hardly reduce it.
        const bool small = glm::all(glm::lessThanEqual(b.upper - b.lower, glm::ivec2(2)));
        for (glm::ivec2 texel = b.lower; texel.y <= b.upper.y; ++texel.y)
            for (texel.x = b.lower.x; texel.x <= b.upper.x; ++texel.x) {
                const Polygon part = small ? whole : cutToReach(whole, texel, size);
                if (part.count == 0)
                    continue;
                const glm::ivec2 local = texel - box.lower;
                std::int32_t& k = indexOf[std::size_t(local.y * extent.x + local.x)];
                if (k < 0) {
                    constexpr float kFar = std::numeric_limits<float>::max();
                    k = std::int32_t(out.size());
                    out.push_back({std::uint32_t(texel.y * size.x + texel.x),
                                   {{glm::vec3(kFar), glm::vec3(-kFar)}, glm::vec3(0), 1}});
                }
                add(out[std::size_t(k)].footprint, part, normal);
            }
    }
}

void addSide(const InstanceLookup& in, std::vector<TexelFootprint>& out) {
    const MeshCharts& charts = in.layout.meshes[in.instance().mesh];
    const std::vector<std::uint32_t> triangles = byChart(charts);
    std::vector<std::int32_t> scratch;
    for (std::size_t begin = 0, end = 0; begin < triangles.size(); begin = end) {
        const std::uint32_t chart = charts.chartOfTriangle[triangles[begin]];
        while (end < triangles.size() && charts.chartOfTriangle[triangles[end]] == chart)
            ++end;
        addChart(in, std::span(triangles).subspan(begin, end - begin), scratch, out);
    }
}

/// Planes through the eye, with normals inwards, and the plane that the camera looks from.
struct FieldOfView {
    glm::vec3 eye;
    std::array<glm::vec3, 5> inwards;

    FieldOfView(const Camera& camera, float aspect) : eye(camera.eye) {
        const glm::vec3 ahead = rayDirection(camera, aspect, 0, 0),
                        right = kWider * (rayDirection(camera, aspect, 1, 0) - ahead),
                        up = kWider * (rayDirection(camera, aspect, 0, 1) - ahead);
        // Orthogonal: ahead of length 1, right and up of the tangents.
        inwards = {ahead, ahead * glm::dot(right, right) + right,
                   ahead * glm::dot(right, right) - right, ahead * glm::dot(up, up) + up,
                   ahead * glm::dot(up, up) - up};
    }

    bool meets(const Bounds& b) const {
        const glm::vec3 toCentre = b.centre() - eye, half = b.size() * 0.5f;
        return std::ranges::all_of(inwards, [&](glm::vec3 n) {
            return glm::dot(n, toCentre) + glm::dot(glm::abs(n), half) >= 0;
        });
    }

    /// Whether some point of the footprint may face the eye.
    bool faces(const CacheFootprint& f) const {
        if (f.normal == glm::vec3(0))
            return true;
        const glm::vec3 toEye = eye - f.bounds.centre();
        const float radius = glm::length(f.bounds.size()) * 0.5f;
        const float along = glm::dot(f.normal, toEye);
        const float across = glm::length(toEye - f.normal * along);
        const float sinSpread = std::sqrt(std::max(0.f, 1 - f.cosSpread * f.cosSpread));
        if (along >= 0)
            return true;
        // The maximum of dot(n, eye - p), with n turned towards the eye as far as the spread
        // allows.
        const float box =
            f.cosSpread > 0.99999f ? glm::dot(glm::abs(f.normal), f.bounds.size() * 0.5f) : radius;
        return along * f.cosSpread + across * sinSpread + box >=
               -kEdgeOn * (glm::length(toEye) + radius);
    }
};

} // namespace

/// Removes the texels of blocks. Blocks lie directly below the charts, whose reach ends a little
/// beyond their last row.
static void removeFineTexels(const LightmapLayout& layout, std::vector<std::uint32_t>& cacheOf) {
    const std::size_t places = std::min(layout.snaps.size(), cacheOf.size());
    for (std::size_t i = 0; i < places; ++i) {
        if (!(layout.snaps[i] & kFineLookup))
            continue;
        const std::uint32_t first = layout.snaps[i] & ~kFineLookup;
        for (std::uint32_t y = 0; y <= kFineCells; ++y)
            std::fill_n(cacheOf.begin() + first + y * layout.width, kFineCells + 1, ~0U);
    }
}

CacheFootprints cacheFootprints(const Scene& scene, const Bake& bake) {
    const LightmapLayout& layout = bake.lightmap;
    const Caches& caches = bake.caches;
    std::vector<std::vector<TexelFootprint>> found(scene.instances.size());
    parallelRanges(found.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (i < layout.instances.size() && !layout.instances[i].uv.empty())
                for (const bool back : {false, true})
                    if (!back || layout.instances[i].backRows > 0)
                        addSide({scene, layout, std::uint32_t(i), back}, found[i]);
    });
    std::vector<std::uint32_t> cacheOf(std::size_t(layout.width) * layout.height, ~0U);
    for (std::uint32_t c = 0; c < caches.lightmapCount; ++c)
        cacheOf[caches.texel[c]] = c;
    removeFineTexels(layout, cacheOf);
    CacheFootprints out;
    out.begin.assign(caches.lightmapCount + 1, 0);
    const auto forEach = [&](auto visit) {
        for (const auto& ofInstance : found)
            for (const TexelFootprint& f : ofInstance)
                if (cacheOf[f.texel] != ~0U)
                    visit(cacheOf[f.texel], f.footprint);
    };
    forEach([&](std::uint32_t c, const CacheFootprint&) { ++out.begin[c + 1]; });
    for (std::uint32_t c = 0; c < caches.lightmapCount; ++c)
        out.begin[c + 1] += out.begin[c];
    out.footprints.resize(out.begin.back());
    std::vector<std::uint32_t> next(out.begin.begin(), out.begin.end() - 1);
    forEach([&](std::uint32_t c, const CacheFootprint& f) { out.footprints[next[c]++] = f; });
    return out;
}

CacheFlags seenCaches(const CacheFootprints& in, const Camera& camera, float aspect) {
    const FieldOfView view(camera, aspect);
    CacheFlags seen(in.begin.size() - 1, 0);
    parallelRanges(seen.size(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            const std::span parts(in.footprints.begin() + in.begin[c],
                                  in.footprints.begin() + in.begin[c + 1]);
            seen[c] = parts.empty() || std::ranges::any_of(parts, [&](const CacheFootprint& f) {
                          return view.meets(f.bounds) && view.faces(f);
                      });
        }
    });
    return seen;
}

const CacheFlags& seenFrom(SeenFrom& from, const Scene& scene, const Bake& bake,
                           const Viewpoint& view) {
    if (from.footprints.begin.empty())
        from.footprints = cacheFootprints(scene, bake);
    if (from.view != view)
        from.seen = seenCaches(from.footprints, view.camera, view.aspect);
    from.view = view;
    return from.seen;
}

} // namespace limn
