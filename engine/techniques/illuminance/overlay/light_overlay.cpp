// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/overlay/light_overlay.h"

#include "engine/math/luminance.h"
#include "engine/math/sampling.h"
#include "engine/math/sh.h"
#include "engine/overlay/light_marks.h"
#include "engine/overlay/palette.h"
#include "engine/techniques/illuminance/overlay/dependencies.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kMaxLobes = 500;                 // when no cache is picked
constexpr std::uint32_t kDots = 192, kPickedDots = 1536; // of a lobe
constexpr float kPickedScale = 3;                        // a picked lobe may reach into others

OverlayData note(std::string title, std::string text) {
    OverlayData out;
    out.legend = {std::move(title), {}, {std::move(text)}};
    return out;
}

OverlayData radiosityOverlay(const Bake& bake, const LitBake& lit, std::string title,
                             const std::vector<std::uint32_t>& nodeOf) {
    const Surfels& s = bake.surfels;
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        sum += double(luminance(glm::vec3(lit.radiosity[i])) * s.area[i]);
        area += double(s.area[i]);
    }
    const float middle = area > 0 && sum > 0 ? float(sum / area) : 1;
    std::vector<glm::vec3> colors(s.size());
    for (std::size_t i = 0; i < s.size(); ++i)
        colors[i] = lightColor(lit.radiosity[nodeOf[i]], middle);
    OverlayData out;
    out.marks = surfelMarks(s, colors);
    out.legend.title = std::move(title);
    out.legend.entries = lightColorEntries(middle, "lux");
    out.legend.notes = {
        fmt::format("Radiosity, {:.3g} lux on average; {:.4g} lm in all", middle, sum),
        "A colour's brightness rises ever slower"};
    return out;
}

/// Maximum reach of lobes that do not run into each other [m].
float spacing(const Bake& bake, bool grid, std::uint32_t every) {
    const glm::vec3 size = bake.gridBounds.size();
    if (grid) {
        const glm::vec3 cell = size / glm::vec3(glm::max(bake.gridSize, 1U));
        return 0.5f * std::min({cell.x, cell.y, cell.z});
    }
    double area = 0;
    for (const float a : bake.surfels.area)
        area += double(a);
    const auto texels = double(std::max(bake.caches.lightmapCount, 1U));
    return 0.5f * float(std::sqrt(area * every / texels));
}

OverlayData lobeOverlay(const Bake& bake, const LitBake& lit, std::uint32_t picked) {
    const Caches& caches = bake.caches;
    const auto count = std::uint32_t(caches.size());
    const auto coefficients = std::size_t(lit.bands * lit.bands);
    const bool one = picked < count, grid = one && picked >= caches.lightmapCount;
    const std::uint32_t every = std::max(1U, (caches.lightmapCount + kMaxLobes - 1) / kMaxLobes);
    const DirectionSet directions(one ? kPickedDots : kDots, true, 0);
    std::vector<float> basis(directions.count * coefficients);
    for (std::uint32_t k = 0; k < directions.count; ++k)
        shBasis(lit.bands, directions[k], basis.data() + k * coefficients);
    const float reach = spacing(bake, grid, every) * (one ? kPickedScale : 1);

    OverlayData out;
    std::uint32_t lobes = 0;
    double minimum = 0, maximum = 0;
    std::vector<float> bright(directions.count);
    std::vector<glm::vec3> hue(directions.count);
    for (std::uint32_t c = one ? picked : 0; c < (one ? picked + 1 : caches.lightmapCount); ++c) {
        if (!one && mixBits(c) % every != 0) // regular steps would pick texels in rows
            continue;
        const glm::vec3* sh = lit.cacheSh.data() + c * coefficients;
        for (std::uint32_t k = 0; k < directions.count; ++k) {
            glm::vec3 radiance(0);
            for (std::size_t i = 0; i < coefficients; ++i)
                radiance += sh[i] * basis[k * coefficients + i];
            bright[k] = luminance(radiance);
            hue[k] = lightHue(radiance);
            minimum = std::min(minimum, double(bright[k]));
            maximum = std::max(maximum, double(bright[k]));
        }
        const bool cell = caches.kind[c] == CacheKind::Grid;
        addLobe({caches.position[c] + (cell ? 0.f : 0.1f * reach) * caches.normal[c], reach},
                directions, bright, hue, out.marks);
        ++lobes;
    }
    out.legend.title = one ? fmt::format("Light at cache {}, {} bands", picked, lit.bands)
                           : fmt::format("Light at caches, {} bands", lit.bands);
    out.legend.entries = {
        {packColor(glm::vec3(1)),
         fmt::format("light from there, in its own colour, up to {:.3g} nits", maximum)},
        {packColor(kNegativeLight), fmt::format("less than none, to {:.3g} nits", minimum)}};
    out.legend.notes = {
        one ? "The longest ray of the lobe is the brightest direction"
            : fmt::format("{} of {} lightmap texels; each lobe's longest ray has the same length; "
                          "pick a cache to see it alone",
                          lobes, caches.lightmapCount)};
    return out;
}

} // namespace

OverlayData lightOverlay(const Bake& bake, const Scene& scene, const OverlayOptions& options,
                         const LitBake* lit) {
    if (!lit || lit->radiosity.size() != bake.tree.size())
        return note(kOverlays[std::size_t(options.kind)].label, "Nothing is lit yet");
    if (options.kind == Overlay::Lobes)
        return lobeOverlay(bake, *lit, options.cache);
    if (options.kind == Overlay::Dependencies)
        return dependencyOverlay(bake, scene, options, *lit);
    if (options.kind == Overlay::LitClusters)
        return radiosityOverlay(
            bake, *lit,
            fmt::format("Lit clusters at depth {} of {}", options.depth, treeDepth(bake.tree)),
            clustersAtDepth(bake.tree, options.depth));
    return radiosityOverlay(bake, *lit, "Lit surfels", clustersAtDepth(bake.tree, ~0u));
}

} // namespace limn
