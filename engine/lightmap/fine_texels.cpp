// SPDX-License-Identifier: MIT
#include "engine/lightmap/fine_texels.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/texel_cover.h"
#include "engine/lightmap/texel_points.h"
#include "engine/math/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <glm/common.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kNone = ~0U, kBlock = kFineCells + 1; ///< texels along a block's side
constexpr std::uint32_t kBlockTexels = kBlock * kBlock;
constexpr std::uint32_t kRaysPerTexel = 4;

/// A triangle in the lookups of one place, in texels of a block that may be added there.
struct BlockTriangle {
    std::uint32_t place;
    FlatTriangle flat;
};

/// Triangles of the charts whose density varies.
std::vector<PlacedTriangle> variedTriangles(const Scene& scene, const BakeDensity& density,
                                            const LightmapLayout& layout) {
    std::vector<PlacedTriangle> result;
    for (const VariedChart& v : density.varied) {
        const std::uint32_t mesh = scene.instances[v.instance].mesh;
        const std::vector<std::uint32_t>& chartOf = layout.meshes[mesh].chartOfTriangle;
        const std::uint32_t sides = layout.instances[v.instance].backRows > 0 ? 2 : 1;
        for (std::uint32_t back = 0; back < sides; ++back)
            for (std::uint32_t t = 0; t < chartOf.size(); ++t)
                if (chartOf[t] == v.chart)
                    result.push_back(placeTriangle(layout, mesh, v.instance, back, t));
    }
    return result;
}

/// Computes how triangles lie in the places selected by wanted(place, triangle), sorted by place.
template <class Wanted>
std::vector<BlockTriangle> partTriangles(const std::vector<PlacedTriangle>& triangles,
                                         std::uint32_t width, const Wanted& wanted) {
    constexpr float kReach = 0.5f / float(kFineCells);
    std::vector<BlockTriangle> result;
    for (const PlacedTriangle& t : triangles) {
        const auto& p = t.corner;
        const glm::ivec2 lower = glm::max(
            glm::ivec2(glm::floor(glm::min(p[0], glm::min(p[1], p[2])) - kReach)), t.lower);
        const glm::ivec2 upper = glm::min(
            glm::ivec2(glm::floor(glm::max(p[0], glm::max(p[1], p[2])) + kReach)), t.upper - 1);
        for (int y = lower.y; y <= upper.y; ++y)
            for (int x = lower.x; x <= upper.x; ++x) {
                const std::uint32_t place = std::uint32_t(y) * width + std::uint32_t(x);
                if (!wanted(place, t))
                    continue;
                BlockTriangle part{place, {t.triangle, {}}};
                for (std::size_t k = 0; k < 3; ++k)
                    part.flat.corner[k] =
                        (p[k] - glm::vec2(float(x), float(y))) * float(kFineCells) + 0.5f;
                result.push_back(part);
            }
    }
    std::ranges::stable_sort(result, {}, &BlockTriangle::place);
    return result;
}

/// Calls visit(place, its triangles) for each place.
template <class Visit>
void forPlaces(const std::vector<BlockTriangle>& parts, const Visit& visit) {
    for (std::size_t begin = 0, end = 0; begin < parts.size(); begin = end) {
        while (end < parts.size() && parts[end].place == parts[begin].place)
            ++end;
        visit(parts[begin].place, std::span(parts).subspan(begin, end - begin));
    }
}

std::vector<LocalTexel> coverBlock(std::span<const BlockTriangle> parts) {
    std::vector<FlatTriangle> flat;
    for (const BlockTriangle& p : parts)
        flat.push_back(p.flat);
    return coverTriangles(flat, glm::uvec2(kBlock));
}

/// Texels of an atlas, indexed by their position.
struct TexelGrid {
    const Scene& scene;
    const Atlas& atlas;
    std::vector<std::uint32_t> at; ///< per place: into Atlas::texels

    TexelGrid(const Scene& s, const Atlas& a)
        : scene(s), atlas(a), at(std::size_t(a.layout.width) * a.layout.height, kNone) {
        for (std::uint32_t i = 0; i < a.texels.size(); ++i)
            at[a.texels[i].texel] = i;
    }

    const AtlasTexel& operator[](std::uint32_t place) const { return atlas.texels[at[place]]; }

    /// Whether the lookups at a place belong to the triangle's side and chart.
    bool holds(std::uint32_t place, const PlacedTriangle& t) const {
        if (place >= at.size() || at[place] == kNone)
            return false;
        const AtlasTexel& texel = (*this)[place];
        const std::vector<std::uint32_t>& chartOf =
            atlas.layout.meshes[scene.instances[t.instance].mesh].chartOfTriangle;
        return texel.instance == t.instance && texel.back == t.back &&
               chartOf[texel.points[0].triangle] == chartOf[t.triangle];
    }
};

/// Adds rows of texels; coordinates are relative to the atlas' height.
void grow(LightmapLayout& layout, std::uint32_t rows) {
    const float shrink = float(double(layout.height) / double(layout.height + rows));
    layout.height += rows;
    for (InstanceLightmap& i : layout.instances)
        for (glm::vec2& uv : i.uv)
            uv.y *= shrink;
    layout.snaps.resize(std::size_t(layout.width) * layout.height, 0);
}

/// Adds the finer texels of one level. `places` must be ascending. Returns how triangles lie in
/// their lookups.
std::vector<PlacedTriangle> addLevel(const Scene& scene,
                                     const std::vector<PlacedTriangle>& triangles,
                                     const std::vector<std::uint32_t>& places, Atlas& atlas) {
    LightmapLayout& layout = atlas.layout;
    const std::uint32_t perRow = layout.width / kBlock, top = layout.height;
    std::vector<PlacedTriangle> result;
    if (places.empty() || perRow == 0)
        return result;
    const TexelGrid grid(scene, atlas);
    const std::vector<BlockTriangle> parts =
        partTriangles(triangles, layout.width, [&](std::uint32_t place, const PlacedTriangle& t) {
            return grid.holds(place, t) && std::ranges::binary_search(places, place);
        });
    std::vector<AtlasTexel> more;
    const auto count = std::uint32_t(places.size());
    grow(layout, (count + perRow - 1) / perRow * kBlock);
    forPlaces(parts, [&](std::uint32_t place, std::span<const BlockTriangle> of) {
        const auto block = std::uint32_t(std::ranges::lower_bound(places, place) - places.begin());
        const glm::uvec2 first(block % perRow * kBlock, top + block / perRow * kBlock);
        layout.snaps[place] = kFineLookup | (first.y * layout.width + first.x);
        const AtlasTexel& owner = grid[place];
        for (const LocalTexel& t : coverBlock(of)) {
            const glm::uvec2 at = first + t.at;
            more.push_back({at.y * layout.width + at.x, owner.instance, owner.back,
                            owner.width / float(kFineCells), t.count, t.points});
        }
        for (const BlockTriangle& part : of) {
            const glm::ivec2 lower(first);
            result.push_back({owner.instance, owner.back, part.flat.triangle, part.flat.corner,
                              lower, lower + int(kFineCells)});
            for (glm::vec2& c : result.back().corner)
                c += glm::vec2(first) - 0.5f;
        }
    });
    std::ranges::sort(more, {}, &AtlasTexel::texel);
    atlas.texels.insert(atlas.texels.end(), more.begin(), more.end());
    return result;
}

/// Maximum of VariedChart::fours per place, among the finest lookups there.
std::vector<std::int32_t> metAt(const Scene& scene, const BakeDensity& density,
                                const LightmapLayout& layout) {
    constexpr std::int32_t kNothing = -100;
    std::vector<std::int32_t> result(std::size_t(layout.width) * layout.height, kNothing);
    for (const VariedChart& v : density.varied)
        for (std::size_t i = 0; i < v.at.size(); ++i) {
            const MeshPoint& p = v.at[i];
            const AtlasLookup l = lookupAt(
                layout, unsnappedUv(layout, v.instance, scene.instances[v.instance].mesh,
                                    p.triangle, p.barycentric.x, p.barycentric.y, v.back[i] != 0));
            if (l.inside) {
                std::int32_t& at =
                    result[std::size_t(l.base.y) * layout.width + std::size_t(l.base.x)];
                at = std::max(at, v.fours[i]);
            }
        }
    return result;
}

/// Traces rays from a block's texels to find the detail of the quarter that needs most.
class BlockProbe {
public:
    BlockProbe(const TraceScene& trace, const BakeDensity& density)
        : m_trace(trace), m_density(density) {}

    double detail(const AtlasTexel& owner, const std::vector<LocalTexel>& texels) const {
        const Scene& scene = m_trace.scene();
        std::array<double, 4> sum{}, rays{};
        for (const LocalTexel& t : texels) {
            AtlasTexel one = owner;
            one.points[0] = t.points[0];
            const WorldPoint p = texelPoint(scene, one, 0);
            const DirectionSet directions(kRaysPerTexel, false, seedOf(scene, one));
            const glm::mat3 toWorld = basisAround(p.normal);
            const glm::vec3 from = m_trace.clearOf(p.position, p.normal);
            const std::size_t quarter =
                (t.at.x > kFineCells / 2 ? 1U : 0U) + (t.at.y > kFineCells / 2 ? 2U : 0U);
            for (std::uint32_t r = 0; r < kRaysPerTexel; ++r) {
                const Hit hit =
                    m_trace.closestHit({from, toWorld * directions[r]}, TraceMask::Static);
                sum[quarter] += hit ? 1 / std::max(double(hit.t), double(m_density.nearest)) : 0;
                ++rays[quarter];
            }
        }
        double most = 0;
        for (std::size_t q = 0; q < 4; ++q)
            if (rays[q] > 0)
                most = std::max(most, detailOf(sum[q] / rays[q] * m_density.size));
        return most;
    }

private:
    const TraceScene& m_trace;
    const BakeDensity& m_density;
};

} // namespace

std::uint64_t FineLookups::texels() const {
    std::uint64_t count = 0;
    for (const std::vector<std::uint32_t>& level : places)
        count += level.size() * kBlockTexels;
    return count;
}

FineLookups findFineLookups(const TraceScene& trace, const Atlas& atlas, const BakeDensity& density,
                            std::uint32_t most, const Progress& progress) {
    FineLookups result;
    Atlas grown = atlas;
    std::vector<PlacedTriangle> triangles = variedTriangles(trace.scene(), density, grown.layout);
    const BlockProbe probe(trace, density);
    const float base = 1 / grown.texelsPerMetre;
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    while (!triangles.empty() && most >= kBlockTexels) {
        const TexelGrid grid(trace.scene(), grown);
        const std::vector<BlockTriangle> parts = partTriangles(
            triangles, grown.layout.width,
            [&](std::uint32_t place, const PlacedTriangle& t) { return grid.holds(place, t); });
        const std::vector<std::int32_t> met = metAt(trace.scene(), density, grown.layout);
        struct Candidate {
            std::uint32_t place;
            std::span<const BlockTriangle> parts;
            double detail;
            std::uint64_t rays;
        };
        std::vector<Candidate> all;
        forPlaces(parts, [&](std::uint32_t place, std::span<const BlockTriangle> of) {
            all.push_back({place, of, 0, 0});
        });
        parallelRanges(all.size(), 16, quiet, "charts", [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const AtlasTexel& owner = grid[all[i].place];
                const std::vector<LocalTexel> texels = coverBlock(all[i].parts);
                all[i].rays = texels.size() * kRaysPerTexel;
                // Texels of width base / 4^k have class k, besides the instance's own density.
                const float own = trace.scene().instances[owner.instance].texelDensity;
                const double has = std::log2(double(base / (owner.width * own))) / 2;
                // A single ray overestimates how near everything is; it counts as one class less.
                const double detail =
                    std::max(probe.detail(owner, texels),
                             std::exp2(4. * (met[all[i].place] - 1)) * density.centre);
                const bool deserves =
                    densityClass(std::max(detail, 1e-30), density.centre) > int(std::lround(has));
                all[i].detail = deserves ? detail : 0;
            }
        });
        if (progress.cancelled())
            return {};
        for (const Candidate& c : all)
            result.rays += c.rays;
        std::erase_if(all, [](const Candidate& c) { return !(c.detail > 0); });
        std::ranges::stable_sort(all, std::greater<>(), &Candidate::detail);
        all.resize(std::min<std::size_t>(all.size(), most / kBlockTexels));
        most -= std::uint32_t(all.size()) * kBlockTexels;
        std::vector<std::uint32_t> places;
        for (const Candidate& c : all)
            places.push_back(c.place);
        std::ranges::sort(places);
        if (places.empty())
            break;
        triangles = addLevel(trace.scene(), triangles, places, grown);
        result.places.push_back(std::move(places));
    }
    return result;
}

std::vector<PlacedTriangle> addFineTexels(const Scene& scene, const BakeDensity& density,
                                          const FineLookups& lookups, Atlas& atlas) {
    std::vector<PlacedTriangle> level = variedTriangles(scene, density, atlas.layout), all;
    for (const std::vector<std::uint32_t>& places : lookups.places) {
        level = addLevel(scene, level, places, atlas);
        all.insert(all.end(), level.begin(), level.end());
    }
    return all;
}

} // namespace limn
