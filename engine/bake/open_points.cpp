// SPDX-License-Identifier: MIT
#include "engine/bake/open_points.h"

#include "engine/bake/cache_points.h"
#include "engine/bake/surfels.h"
#include "engine/core/parallel.h"
#include "engine/math/sampling.h"

namespace limn {

namespace {

constexpr std::uint32_t kProbesPerPoint = 8;

std::uint32_t countOpen(const TraceScene& trace, float reach, const WorldPoint& point,
                        std::uint32_t seed) {
    const DirectionSet directions(kProbesPerPoint, false, seed);
    const glm::mat3 toWorld = basisAround(point.normal);
    std::uint32_t open = 0;
    for (std::uint32_t i = 0; i < kProbesPerPoint; ++i) {
        const Hit hit =
            trace.closestHit({trace.clearOf(point.position, point.normal), toWorld * directions[i]},
                             TraceMask::Static);
        const bool inSolid =
            hit && !hit.frontFace &&
            !isTwoSided(trace.scene().materialOf(trace.scene().instances[hit.instance]));
        open += inSolid || (hit && hit.t < reach) ? 0 : 1;
    }
    return open;
}

void favourOpen(const TraceScene& trace, float reach, AtlasTexel& texel) {
    constexpr std::uint32_t kSlots = AtlasTexel::kMostPoints;
    const Scene& scene = trace.scene();
    const std::uint32_t seed = seedOf(scene, texel);
    std::array<std::uint32_t, kSlots> open;
    std::uint32_t sum = 0;
    for (std::uint32_t k = 0; k < texel.count; ++k)
        sum += open[k] = countOpen(trace, reach, texelPoint(scene, texel, k), seed + k);
    if (sum == 0)
        return;
    const std::array<MeshPoint, kSlots> from = texel.points;
    std::uint32_t k = 0, passed = open[0]; // of the points up to k
    for (std::uint32_t slot = 0; slot < kSlots; ++slot) {
        while (2 * kSlots * passed <= (2 * slot + 1) * sum)
            passed += open[++k];
        texel.points[slot] = from[k];
    }
    texel.count = kSlots;
}

} // namespace

std::vector<AtlasTexel> withOpenPoints(const TraceScene& trace, const Progress& progress,
                                       const Atlas& atlas, std::uint64_t& rays) {
    std::vector<AtlasTexel> texels = atlas.texels;
    for (const AtlasTexel& t : texels)
        rays += t.count > 1 ? t.count * kProbesPerPoint : 0;
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    parallelRanges(texels.size(), 64, quiet, "charts", [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t)
            if (texels[t].count > 1)
                favourOpen(trace, 1 / atlas.texelsPerMetre, texels[t]);
    });
    return texels;
}

} // namespace limn
