// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/probe_surface_overlay.h"

#include "engine/core/parallel.h"
#include "engine/field/grid_cells.h"
#include "engine/field/sample_field.h"
#include "engine/overlay/palette.h"
#include "engine/techniques/probes/march_ray.h"
#include "engine/techniques/probes/probe_planes.h"

#include <algorithm>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kMarkScale = 0.8f;        // of what a texel covers, so that marks stay apart
constexpr std::uint32_t kDrawnPaths = 64; // of a probe's reflections
constexpr std::uint32_t kDotsAlongPath = 32;
constexpr float kPathScale = 0.01f; // a dot's radius over the distance of probes

const glm::vec3 kHitColor(0.13f, 0.57f, 0.55f), kMissColor(0.75f, 0.9f, 1), kUnknownColor(1, 0, 1);

/// A surface that a probe sees.
struct SeenPoint {
    glm::vec3 position, normal; ///< unit, on the side that is seen
    glm::vec3 from;             ///< the probe
    float radius;               ///< of a mark for it [m]
};

OverlayMark markAt(const SeenPoint& p, glm::vec3 color, MarkShape shape = MarkShape::Disc) {
    return {.position = p.position + glm::normalize(p.from - p.position) * p.radius,
            .radius = p.radius,
            .color = packColor(color),
            .shape = shape};
}

/// Calls visit(point) for all surfaces that a probe sees, except the backs of solids.
template <class Visit>
void forSeen(const ProbeMaps& maps, const Scene& scene, std::uint32_t probe, const Visit& visit) {
    const glm::vec3 from = maps.grid.position(probe);
    for (std::uint32_t t = 0; t < maps.map.texels(); ++t) {
        const ProbeHit& hit = maps.hits[std::size_t(probe) * maps.map.texels() + t];
        if (hit.instance == ~0U || hit.side == kInSolid || !(hit.distance > 0))
            continue;
        visit(SeenPoint{from + maps.map.direction(t) * hit.distance, seenNormal(scene, hit), from,
                        kMarkScale * hit.distance / float(maps.map.side)});
    }
}

/// The probe itself and those beside it, also across edges and corners, that are not in solids.
std::vector<std::uint32_t> neighbours(const ProbeMaps& maps, std::uint32_t probe) {
    const glm::ivec3 size(maps.grid.size),
        cell(int(probe) % size.x, int(probe) / size.x % size.y, int(probe) / size.x / size.y);
    std::vector<std::uint32_t> found;
    for (int k = 0; k < 27; ++k) {
        const glm::ivec3 c = cell + glm::ivec3(k % 3, k / 3 % 3, k / 9) - 1;
        if (c != glm::clamp(c, glm::ivec3(0), size - 1))
            continue;
        const auto p = std::uint32_t((c.z * size.y + c.y) * size.x + c.x);
        if (!maps.inSolid[p])
            found.push_back(p);
    }
    return found;
}

/// Marks surfaces that look up the probe, coloured by valueOf(point) in [0, 1].
template <class ValueOf>
OverlayData surfaceOverlay(const ProbeMaps& maps, const Scene& scene, std::uint32_t probe,
                           const ValueOf& valueOf) {
    OverlayData out;
    out.marks.push_back(
        {.position = maps.grid.position(probe),
         .radius = 0.2f * std::min({maps.grid.step().x, maps.grid.step().y, maps.grid.step().z}),
         .color = packColor(maps.inSolid[probe] ? kUnknownColor : glm::vec3(1)),
         .shape = MarkShape::Ring});
    for (const std::uint32_t neighbour : neighbours(maps, probe))
        forSeen(maps, scene, neighbour, [&](const SeenPoint& p) {
            const CellsAbout about = cellsAbout(maps.grid.bounds, maps.grid.size, p.position);
            if (std::ranges::count(about.index, probe) > 0)
                out.marks.push_back(markAt(p, viridis(valueOf(p))));
        });
    for (int k = 4; k >= 0; --k)
        out.legend.entries.push_back(
            {packColor(viridis(float(k) / 4)), fmt::format("{} %", 25 * k)});
    if (maps.inSolid[probe])
        out.legend.notes = {"It stands in a solid and is not used"};
    return out;
}

} // namespace

OverlayData probeWeightOverlay(const ProbeMaps& maps, const Scene& scene, std::uint32_t probe) {
    IndirectField field;
    field.gridSize = maps.grid.size;
    field.gridBounds = maps.grid.bounds;
    field.gridMoments = std::make_shared<const GridMoments>(maps.moments);
    OverlayData out = surfaceOverlay(maps, scene, probe, [&](const SeenPoint& p) {
        const FieldLookup lookup = gridLookup(field, p.position, p.normal);
        float share = 0;
        for (std::size_t k = 0; k < lookup.count; ++k)
            share += lookup.index[k] == probe ? lookup.weight[k] : 0;
        return share;
    });
    out.legend.title = fmt::format("Weight of probe {} on surfaces", probe);
    out.legend.notes.emplace_back("Share of a surface's light that is taken from this one of the "
                                  "eight probes around it");
    return out;
}

OverlayData probeVisibilityOverlay(const ProbeMaps& maps, const Scene& scene, std::uint32_t probe) {
    const glm::vec3 centre = maps.grid.position(probe);
    OverlayData out = surfaceOverlay(maps, scene, probe, [&](const SeenPoint& p) {
        return momentsSeen(maps.moments, probe, p.position - centre);
    });
    out.legend.title = fmt::format("What probe {} counts as seen", probe);
    out.legend.notes.emplace_back(
        "From the mean and the variance of distances in a cone: a surface that is hidden and "
        "bright here is lit through what hides it");
    return out;
}

OverlayData probeMarchOverlay(const ProbeMaps& maps, const Scene& scene, std::uint32_t probe) {
    MarchedMaps marched = emptyMarchedMaps(maps.grid.size, maps.grid.bounds, maps.map.side);
    parallelRanges(maps.grid.count(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p)
            writePlanes(scene, maps, std::uint32_t(p), marched);
    });
    const glm::vec3 size = maps.grid.bounds.size(), step = maps.grid.step();
    const float offset = float(MARCH_OFFSET) * (size.x + size.y + size.z),
                dot = kPathScale * std::min({step.x, step.y, step.z});
    OverlayData out;
    std::uint32_t rays = 0, ends[3] = {};
    const std::uint32_t every = std::max(maps.map.texels() / kDrawnPaths, 1U);
    forSeen(maps, scene, probe, [&](const SeenPoint& p) {
        const glm::vec3 origin = p.position + p.normal * offset,
                        way = glm::reflect(glm::normalize(p.position - p.from), p.normal);
        const MarchedRay ray = marchRay(marched, origin, way);
        const bool hit = ray.end == MarchEnd::Hit, miss = ray.end == MarchEnd::Miss;
        const glm::vec3 color = hit ? kHitColor : miss ? kMissColor : kUnknownColor;
        ++ends[std::size_t(ray.end)];
        out.marks.push_back(markAt(p, color, hit || miss ? MarkShape::Disc : MarkShape::Square));
        const float length = std::min(miss ? glm::length(step) : ray.t, glm::length(size));
        for (std::uint32_t k = 1; rays % every == every / 2 && k <= kDotsAlongPath; ++k)
            out.marks.push_back({.position = origin + way * (length * float(k) / kDotsAlongPath),
                                 .radius = (k == kDotsAlongPath && hit ? 3.f : 1.f) * dot,
                                 .color = packColor(color)});
        ++rays;
    });
    const auto entry = [&](glm::vec3 color, const char* shape, MarchEnd end, const char* what) {
        out.legend.entries.push_back(
            {packColor(color), fmt::format("{}: {} {}", shape, ends[std::size_t(end)], what)});
    };
    out.legend.title = fmt::format("Reflections where probe {} looks", probe);
    entry(kHitColor, "disc", MarchEnd::Hit, "meet a surface");
    entry(kMissColor, "disc", MarchEnd::Miss, "meet the sky");
    entry(kUnknownColor, "square", MarchEnd::Unknown, "unknown: no probe sees where they go");
    out.legend.notes = {fmt::format("{} rays are marched as if all that the probe sees were "
                                    "mirrors; the path of one in {} is drawn",
                                    rays, every)};
    if (maps.inSolid[probe])
        out.legend.notes.emplace_back("The probe stands in a solid and is not used");
    return out;
}

} // namespace limn
