// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/lit_texels.h"

#include "engine/core/parallel.h"
#include "engine/final_lightmap/texel_sharing.h"
#include "engine/lightmap/lightmap_pages.h"
#include "engine/lightmap/plain_lightmap.h"
#include "engine/lightmap/texel_side.h"
#include "engine/picture/gathered_light.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace limn {

/// As SideFinder::choose(), for a texel with points in the cut scene and this part of its width.
static TexelSide chooseWithin(float reach, const SideFinder& sides, const CutScene& cut,
                              AtlasTexel& texel) {
    AtlasTexel before = texel; // with its points in the scene before it was cut
    for (std::uint32_t k = 0; k < texel.count; ++k)
        before.points[k] = cut.toSource(texel.instance, texel.points[k]);
    AtlasTexel kept = before;
    kept.width *= reach;
    TexelSide side = sides.choose(kept);
    const AtlasTexel all = texel;
    texel.count = kept.count;
    for (std::uint32_t k = 0; k < kept.count; ++k) {
        const auto* same = std::ranges::find(before.points, kept.points[k]);
        texel.points[k] = all.points[std::size_t(same - before.points.begin())];
    }
    return side;
}

/// Keeps the points of a texel that lie on its most open side. Looks less and less far where no
/// point is open, because a surface in a narrow gap is seen, however wide its texels are.
static Openness chooseSide(const SideFinder& sides, const CutScene& cut, AtlasTexel& texel,
                           TexelSide& side) {
    constexpr float kCloser = 0.25f, kClosest = 0.01f;
    side = chooseWithin(1, sides, cut, texel);
    if (side.open)
        return Openness::Open;
    for (float reach = kCloser; reach > kClosest && !side.open; reach *= kCloser)
        side = chooseWithin(reach, sides, cut, texel);
    return side.open ? Openness::Narrow : Openness::Closed;
}

/// An atlas may have so many times the texels that it is to have, for those that no lookup reads.
static constexpr double kWaste = 1.25;

/// The longest side that has to fit into a texture.
static std::uint32_t sideOf(const Scene& scene, const LightmapLayout& layout, bool onePage) {
    return onePage ? std::max(layout.width, layout.height) : largestChart(scene, layout).side;
}

/// The atlas of about so many texels, or of fewer where its sides would be too long.
static Atlas layAtlas(const Scene& scene, const std::vector<MeshCharts>& charts,
                      const ChartFactors& factors, const LitTexelCount& count,
                      const Progress& progress) {
    BakeSettings settings = scene.bake;
    settings.texelsPerMetre = 0;
    settings.lightmapCaches = count.texels;
    for (;;) {
        Atlas atlas = buildAtlas(scene, charts, settings, factors, progress);
        const std::uint32_t side = sideOf(scene, atlas.layout, count.onePage);
        const double texels = double(atlas.layout.width) * atlas.layout.height,
                     allowed = kWaste * double(count.texels);
        if (progress.cancelled() || settings.lightmapCaches == 1 ||
            (side <= count.maxSide && texels <= allowed))
            return atlas;
        const double shrunk = std::min(std::pow(double(count.maxSide) / side, 2), allowed / texels);
        settings.lightmapCaches =
            std::max(std::uint32_t(settings.lightmapCaches * std::min(shrunk, 0.95)), 1U);
    }
}

LitTexels layLitTexels(const CutScene& cut, const ChartFactors& factors, const LitTexelCount& count,
                       const Progress& progress) {
    LitTexels lit;
    progress.at("texels", 0);
    lit.atlas = layAtlas(cut.scene, cut.charts, factors, count, progress);
    const LightmapLayout& layout = lit.atlas.layout;
    lit.texelAt.assign(std::size_t(layout.width) * layout.height, kNoTexel);
    for (std::uint32_t i = 0; i < lit.atlas.texels.size(); ++i)
        lit.texelAt[lit.atlas.texels[i].texel] = i;
    lit.open.assign(lit.atlas.texels.size(), Openness::Open);
    lit.links.resize(lit.texelAt.size());
    return lit;
}

void findOpenTexels(const TraceScene& trace, const std::vector<MeshCharts>& charts,
                    const CutScene& cut, LitTexels& lit, const Progress& progress) {
    std::atomic<std::uint64_t> rays = 0;
    Atlas before; // of which the sides read the charts alone
    before.layout.meshes = charts;
    const SideFinder sides{trace, before, rays};
    std::vector<TexelSide> side(lit.atlas.texels.size());
    constexpr std::size_t kGrain = 64;
    const bool done = parallelRanges(
        side.size(), kGrain, progress, "texels", [&](std::size_t begin, std::size_t end) {
            for (std::size_t t = begin; t < end; ++t)
                lit.open[t] = chooseSide(sides, cut, lit.atlas.texels[t], side[t]);
        });
    if (done)
        lit.links = findSharing(sides, cut, lit, side, progress);
}

} // namespace limn
