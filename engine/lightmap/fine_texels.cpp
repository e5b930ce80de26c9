// SPDX-License-Identifier: MIT
#include "engine/lightmap/fine_texels.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/texel_points.h"
#include "engine/math/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include <glm/common.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kRaysPerTexel = 4;

/// Maximum of VariedChart::fours per place, among the finest lookups there.
std::vector<std::int32_t> metAt(const Scene& scene, const BakeDensity& density,
                                const LightmapLayout& layout) {
    constexpr std::int32_t kNothing = -100;
    std::vector<std::int32_t> result(std::size_t(layout.width) * layout.height, kNothing);
    for (const VariedChart& v : density.varied)
        for (std::size_t i = 0; i < v.points.size(); ++i) {
            const MeshPoint& p = v.points[i];
            const AtlasLookup l = lookupAt(
                layout, unsnappedUv(layout, v.instance, scene.instances[v.instance].mesh,
                                    p.triangle, p.barycentric.x, p.barycentric.y, v.back[i] != 0));
            if (l.inside) {
                std::int32_t& fours =
                    result[std::size_t(l.base.y) * layout.width + std::size_t(l.base.x)];
                fours = std::max(fours, v.fours[i]);
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
            const std::size_t quarter = (t.position.x > kFineCells / 2 ? 1U : 0U) +
                                        (t.position.y > kFineCells / 2 ? 2U : 0U);
            for (std::uint32_t r = 0; r < kRaysPerTexel; ++r) {
                const SurfaceHit hit =
                    m_trace.closestSurface({from, toWorld * directions[r]}, TraceMask::Static);
                sum[quarter] += hit ? 1 / std::max(double(hit.t), double(m_density.nearest)) : 0;
                ++rays[quarter];
            }
        }
        double maxDetail = 0;
        for (std::size_t q = 0; q < 4; ++q)
            if (rays[q] > 0)
                maxDetail = std::max(maxDetail, detailOf(sum[q] / rays[q] * m_density.size));
        return maxDetail;
    }

private:
    const TraceScene& m_trace;
    const BakeDensity& m_density;
};

} // namespace

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

FineLookups findFineLookups(const TraceScene& trace, const Atlas& atlas, const BakeDensity& density,
                            std::uint32_t maxTexels, const Progress& progress) {
    FineLookups result;
    Atlas grown = atlas;
    std::vector<PlacedTriangle> triangles = variedTriangles(trace.scene(), density, grown.layout);
    const BlockProbe probe(trace, density);
    const float base = 1 / grown.texelsPerMetre;
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    while (!triangles.empty() && maxTexels >= kBlockTexels) {
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
        forPlaces(parts, [&](std::uint32_t place, std::span<const BlockTriangle> placeParts) {
            all.push_back({place, placeParts, 0, 0});
        });
        parallelRanges(all.size(), 16, quiet, "charts", [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const AtlasTexel& owner = grid[all[i].place];
                const std::vector<LocalTexel> texels = coverBlock(all[i].parts);
                all[i].rays = texels.size() * kRaysPerTexel;
                // Texels of width base / 4^k have class k, besides the instance's own density.
                const float instanceDensity = trace.scene().instances[owner.instance].texelDensity;
                const double has = std::log2(double(base / (owner.width * instanceDensity))) / 2;
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
        all.resize(std::min<std::size_t>(all.size(), maxTexels / kBlockTexels));
        maxTexels -= std::uint32_t(all.size()) * kBlockTexels;
        std::vector<std::uint32_t> places;
        for (const Candidate& c : all)
            places.push_back(c.place);
        triangles = addChosenLevel(trace.scene(), triangles, std::move(places), grown, result);
    }
    return result;
}

} // namespace limn
