// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/final_lightmap/cut_scene.h"
#include "engine/lightmap/atlas.h"
#include "engine/lightmap/plain_lightmap.h"
#include "engine/picture/gathered_light.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Whether light that a texel shows can be seen.
enum class Openness : std::uint8_t {
    Closed, ///< nothing is seen from its points
    Narrow, ///< its points are in gaps narrower than the texel
    Open
};

/// Texels of an exported lightmap, which programs look up bilinearly without LightmapLayout::snaps.
struct LitTexels {
    /// Its layout has no snaps. Each texel keeps points on one side of all walls only, in
    /// proportion to how open each of them is, as findTexelSides() chooses them.
    Atlas atlas;
    std::vector<std::uint32_t> texelAt; ///< index into Atlas::texels, or kNoTexel, at y * width + x
    std::vector<Openness> open;         ///< per texel
    std::vector<SharingLinks> links;    ///< at y * width + x, as findSharing() finds them
};

/// Calls visit(next) for the texels to the right of texel t and below it, if they are of the same
/// side of the same instance.
template <class Visit>
void forNextTexels(const LitTexels& lit, std::uint32_t t, const Visit& visit) {
    const std::vector<AtlasTexel>& texels = lit.atlas.texels;
    const std::uint32_t width = lit.atlas.layout.width, place = texels[t].texel;
    const auto visitAt = [&](bool isInside, std::uint32_t nextPlace) {
        const std::uint32_t next = isInside ? lit.texelAt[nextPlace] : kNoTexel;
        if (next != kNoTexel && texels[next].instance == texels[t].instance &&
            texels[next].back == texels[t].back)
            visit(next);
    };
    visitAt(place % width + 1 < width, place + 1);
    visitAt(place / width + 1 < lit.atlas.layout.height, place + width);
}

/// How many texels there are to be.
struct LitTexelCount {
    std::uint32_t texels = 1; ///< about, > 0
    /// Longest side of a chart, or of the whole lightmap if it is to be one page [texels]. There
    /// are as many fewer texels as that takes.
    std::uint32_t maxSide = 1U << 14;
    bool onePage = false;
};

/// Multiplies the texels per metre, per instance and chart; empty, as a whole or for an instance,
/// means 1.
using ChartFactors = std::vector<std::vector<float>>;

/// Lays texels for all static instances of a cut scene. All are open, and none shares noise, until
/// findOpenTexels(). Incomplete when cancelled.
LitTexels layLitTexels(const CutScene& cut, const ChartFactors& factors, const LitTexelCount& count,
                       const Progress& progress);

/// Finds which points of texels are open, and which neighbours share noise. `trace` and `charts`,
/// per mesh, are those of the scene before it was cut. Incomplete when cancelled.
void findOpenTexels(const TraceScene& trace, const std::vector<MeshCharts>& charts,
                    const CutScene& cut, LitTexels& lit, const Progress& progress);

} // namespace limn
