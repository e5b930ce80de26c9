// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/overlay/light_overlay.h"

#include "engine/math/luminance.h"
#include "engine/math/sampling.h"
#include "engine/math/sh.h"
#include "engine/overlay/palette.h"

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

const glm::vec3 kNegative(1, 0, 0.8f); // magenta, which hardly any light is

/// Maps radiosity to a colour that is never white, of half the full brightness at `middle`.
glm::vec3 toColor(glm::vec3 radiosity, float middle) {
    return encodeSrgb(glm::clamp(radiosity / (luminance(radiosity) + middle), 0.f, 1.f));
}

/// The colour of a dot of a lobe for `radiance`: that of the light, as bright as can be; `shade`
/// darkens it.
std::uint32_t dotColor(glm::vec3 radiance, float shade) {
    const glm::vec3 light = glm::max(radiance, 0.f);
    const float brightest = std::max({light.x, light.y, light.z});
    const bool negative = luminance(radiance) < 0 || !(brightest > 0);
    return packColor((negative ? kNegative : encodeSrgb(light / brightest)) * shade);
}

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
        colors[i] = toColor(lit.radiosity[nodeOf[i]], middle);
    OverlayData out;
    out.marks = surfelMarks(s, colors);
    out.legend.title = std::move(title);
    for (const float times : {0.f, 0.1f, 0.3f, 1.f, 3.f, 10.f})
        out.legend.entries.push_back({packColor(toColor(glm::vec3(times * middle), middle)),
                                      fmt::format("{:.3g} lux", times * middle)});
    out.legend.notes = {
        fmt::format("Radiosity, {:.3g} lux on average; {:.4g} lm in all", middle, sum),
        "A colour's brightness rises ever slower"};
    return out;
}

/// The lobe of one cache: in each direction, a dot at a distance in proportion to the light from
/// there.
struct Lobe {
    glm::vec3 position{0};
    float reach = 0; ///< distance of the farthest dot [m]
};

void addLobe(const Lobe& lobe, const std::vector<glm::vec3>& radiance,
             const DirectionSet& directions, std::vector<OverlayMark>& marks) {
    float most = 0;
    for (const glm::vec3& L : radiance)
        most = std::max(most, std::abs(luminance(L)));
    if (!(most > 0))
        return;
    // With this ratio of radius to distance, the dots of a sphere touch each other.
    const float spread = std::sqrt(4 / float(directions.count));
    for (std::uint32_t k = 0; k < directions.count; ++k) {
        const float r = std::abs(luminance(radiance[k])) / most * lobe.reach;
        // Dots that face down are darker, so that the shape is visible.
        const float shade = 0.7f + 0.3f * directions[k].y;
        OverlayMark m;
        m.position = lobe.position + directions[k] * r;
        m.radius = spread * std::max(r, 0.05f * lobe.reach);
        m.color = dotColor(radiance[k], shade);
        marks.push_back(m);
    }
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
    double least = 0, most = 0;
    std::vector<glm::vec3> radiance(directions.count);
    for (std::uint32_t c = one ? picked : 0; c < (one ? picked + 1 : caches.lightmapCount); ++c) {
        if (!one && mixBits(c) % every != 0) // regular steps would pick texels in rows
            continue;
        const glm::vec3* sh = lit.cacheSh.data() + c * coefficients;
        for (std::uint32_t k = 0; k < directions.count; ++k) {
            radiance[k] = glm::vec3(0);
            for (std::size_t i = 0; i < coefficients; ++i)
                radiance[k] += sh[i] * basis[k * coefficients + i];
            least = std::min(least, double(luminance(radiance[k])));
            most = std::max(most, double(luminance(radiance[k])));
        }
        const bool cell = caches.kind[c] == CacheKind::Grid;
        addLobe({caches.position[c] + (cell ? 0.f : 0.1f * reach) * caches.normal[c], reach},
                radiance, directions, out.marks);
        ++lobes;
    }
    out.legend.title = one ? fmt::format("Light at cache {}, {} bands", picked, lit.bands)
                           : fmt::format("Light at caches, {} bands", lit.bands);
    out.legend.entries = {
        {packColor(glm::vec3(1)),
         fmt::format("light from there, in its own colour, up to {:.3g} nits", most)},
        {packColor(kNegative), fmt::format("less than none, to {:.3g} nits", least)}};
    out.legend.notes = {
        one ? "The longest ray of the lobe is the brightest direction"
            : fmt::format("{} of {} lightmap texels; each lobe's longest ray has the same length; "
                          "pick a cache to see it alone",
                          lobes, caches.lightmapCount)};
    return out;
}

} // namespace

OverlayData lightOverlay(const Bake& bake, const OverlayOptions& options, const LitBake* lit) {
    if (!lit || lit->radiosity.size() != bake.tree.size())
        return note(kOverlays[std::size_t(options.kind)].label, "Nothing is lit yet");
    if (options.kind == Overlay::Lobes)
        return lobeOverlay(bake, *lit, options.cache);
    if (options.kind == Overlay::LitClusters)
        return radiosityOverlay(
            bake, *lit,
            fmt::format("Lit clusters at depth {} of {}", options.depth, treeDepth(bake.tree)),
            clustersAtDepth(bake.tree, options.depth));
    return radiosityOverlay(bake, *lit, "Lit surfels", clustersAtDepth(bake.tree, ~0u));
}

} // namespace limn
