// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/volume_overlay.h"

#include "engine/math/luminance.h"
#include "engine/math/sampling.h"
#include "engine/math/sh.h"
#include "engine/overlay/light_marks.h"
#include "engine/overlay/palette.h"
#include "engine/scene/origin.h"
#include "engine/techniques/radiance_volumes/radiance_volumes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

using Style = OverlayLine::Style;

constexpr std::size_t kMaxMarks = 20000;
constexpr float kCacheScale = 0.12f, kDroppedScale = 0.3f; // a mark's radius over a cell's side
constexpr std::uint32_t kDots = 768;                       // of a lobe
constexpr float kPointScale = 0.008f;                      // over the largest grid's cells' sum
const glm::vec3 kMissedColor(1, 0, 0.8f);
const glm::vec3 kVoxelColor(0.55f, 0.6f, 0.65f), kConeColor(0.95f, 0.75f, 0.1f);

glm::vec3 gridColor(std::uint32_t grid, std::size_t grids) {
    return viridis(grids > 1 ? float(grid) / float(grids - 1) * 0.9f + 0.1f : 0.5f);
}

/// The grid of a cache: caches are numbered by grid, from the coarsest.
std::uint32_t gridOf(const CacheAllocation& caches, std::uint32_t cache) {
    std::uint32_t grid = std::uint32_t(caches.ofGrid.size()) - 1;
    for (std::uint32_t first = caches.ofGrid[grid]; cache >= first; first += caches.ofGrid[grid])
        --grid;
    return grid;
}

void addGridEntries(const CacheAllocation& caches, OverlayLegend& legend) {
    for (std::uint32_t g = 0; g < caches.ofGrid.size(); ++g)
        legend.entries.push_back({packColor(gridColor(g, caches.ofGrid.size())),
                                  fmt::format("cells of {:.3g} m: {} caches",
                                              caches.grids.grids[g].cell, caches.ofGrid[g])});
}

OverlayData cachesOverlay(const CacheAllocation& caches) {
    OverlayData out;
    const std::size_t step = caches.caches() / kMaxMarks + 1;
    for (std::size_t c = 0; c < caches.caches(); c += step) {
        const std::uint32_t grid = gridOf(caches, std::uint32_t(c));
        out.marks.push_back({.position = caches.places[c].position,
                             .radius = kCacheScale * caches.grids.grids[grid].cell,
                             .color = packColor(gridColor(grid, caches.ofGrid.size()))});
    }
    for (const glm::vec3 p : caches.dropped)
        out.marks.push_back({.position = p,
                             .radius = kDroppedScale * caches.grids.grids[0].cell,
                             .color = packColor(kMissedColor),
                             .shape = MarkShape::Ring});
    out.legend.title = "Caches by cascade";
    addGridEntries(caches, out.legend);
    out.legend.entries.push_back(
        {packColor(kMissedColor),
         fmt::format("ring: {} that were one too many", caches.droppedCount)});
    out.legend.notes = {fmt::format("{} caches, {} of them shown", caches.caches(),
                                    (caches.caches() + step - 1) / step),
                        caches.pixels > 0
                            ? fmt::format("Placed for {} pixels, of which {} find none",
                                          caches.pixels, caches.missed)
                            : "Placed for all surfaces: no view was given"};
    return out;
}

OverlayData lobeOverlay(const VolumePart& part, std::uint32_t cache) {
    const DirectionSet directions(kDots, true, 0);
    std::vector<float> value(kDots);
    std::vector<glm::vec3> color(kDots);
    float y[kIrradianceBands * kIrradianceBands];
    for (std::uint32_t k = 0; k < kDots; ++k) {
        shBasis(int(part.bands), directions[k], y);
        glm::vec3 radiance(0);
        for (std::size_t i = 0; i < part.coefficients(); ++i)
            radiance += part.light.harmonics[cache * part.coefficients() + i] * y[i];
        value[k] = luminance(radiance);
        color[k] = lightHue(radiance);
    }
    const CacheAllocation& caches = *part.caches;
    OverlayData out;
    const float cell = caches.grids.grids[gridOf(caches, cache)].cell;
    addLobe({caches.places[cache].position, 2 * cell}, directions, value, color, out.marks);
    out.marks.push_back({.position = caches.places[cache].position,
                         .radius = kCacheScale * cell,
                         .color = packColor(glm::vec3(1))});
    out.legend.title = fmt::format("Light that arrives at cache {}", cache);
    out.legend.entries = {{packColor(kNegativeLight), "less than none from that direction"}};
    out.legend.notes = {"Radiance by direction: the longest ray of the lobe is the brightest"};
    return out;
}

OverlayData cascadesOverlay(const CacheAllocation& caches) {
    OverlayData out;
    const std::size_t grids = caches.ofGrid.size();
    const CacheGrid& largest = caches.grids.grids.back();
    const float radius = kPointScale * largest.cell * float(largest.nodes.x);
    for (const ShownPoint& point : caches.shown) {
        const GridShares shares =
            gridShares(caches.grids, aboveSurface(caches.grids, point.position, point.normal));
        glm::vec3 color(0);
        for (std::size_t k = 0; k < shares.count; ++k)
            color += shares.share[k].weight * gridColor(shares.share[k].grid, grids);
        if (lookUpCaches(caches.grids, caches.address, point.position, point.normal).count == 0)
            color = kMissedColor;
        out.marks.push_back({.position = point.position,
                             .radius = radius,
                             .normal = point.normal,
                             .color = packColor(color)});
    }
    out.legend.title = "Cascades that light surfaces";
    addGridEntries(caches, out.legend);
    out.legend.entries.push_back({packColor(kMissedColor), "no cache"});
    out.legend.notes = {
        fmt::format("{} points of {}; {} of {} pixels find no cache", caches.shown.size(),
                    caches.pixels > 0 ? "the view" : "all surfaces", caches.missed, caches.pixels)};
    return out;
}

/// The block that gives a cache most, and its light; null: none does.
const AreaLightBlock* brightestBlock(const CacheLightInput& input, const CachePlace& cache) {
    std::vector<std::vector<float>> received;
    for (const LitAreaLights& lit : input.lights)
        received.emplace_back(lit.lights->count(), 0.f);
    CacheLightInput open = input; // what is in the shade counts, too
    open.shadows = ConeShadows::None;
    visitArrivals(open, cache, [&](const Arrival& a) {
        const LitAreaLights& lit = input.lights[a.source];
        received[a.source][a.light] = luminance(lit.lights->flux[a.light] * lit.colour) * a.factor;
    });
    const AreaLightBlock* best = nullptr;
    float brightest = 0;
    for (std::size_t s = 0; s < input.lights.size(); ++s)
        for (const AreaLightBlock& block : input.lights[s].lights->blocks) {
            float sum = 0;
            for (std::uint32_t j = block.begin; j < block.end; ++j)
                sum += received[s][j];
            if (sum > brightest) {
                brightest = sum;
                best = &block;
            }
        }
    return best;
}

void addCone(const LitVolume& lit, std::uint32_t cache, OverlayData& out) {
    const std::vector<LitAreaLights> coloured = lit.coloured();
    const CacheLightInput input = lit.input(coloured);
    const CachePlace& place = lit.part->caches->places[cache];
    const AreaLightBlock* block = brightestBlock(input, place);
    if (!block) {
        out.legend.notes.push_back(fmt::format("Cache {} faces no area light", cache));
        return;
    }
    const BlockCone cone = coneOf(input, *block, place);
    const float cell = lit.voxels->lattice.cell, length = glm::distance(cone.from, cone.to) / cell;
    const glm::vec3 step = (cone.to - cone.from) / length;
    for (float d = 2; d + d * cone.sine <= length - 2; d += std::max(1.f, d * cone.sine))
        out.marks.push_back({.position = cone.from + d * step,
                             .radius = std::max(d * cone.sine, 0.25f) * cell,
                             .color = packColor(kConeColor),
                             .shape = MarkShape::Ring});
    out.legend.entries.push_back(
        {packColor(kConeColor), fmt::format("cone of cache {}: {:.0f} % of the light passes", cache,
                                            100 * blockVisibility(input, *block, place))});
}

OverlayData voxelOverlay(const LitVolume& lit, std::uint32_t cache) {
    OverlayData out;
    out.legend.title = "Voxels that cast shadows";
    if (!lit.voxels) {
        out.legend.notes = {"Shadows are off"};
        return out;
    }
    const Lattice& lattice = lit.voxels->lattice;
    const std::size_t count = lit.voxels->solid.count(), step = count / kMaxMarks + 1;
    std::size_t found = 0;
    for (std::uint32_t c = 0; c < lattice.cells(); ++c)
        if (lit.voxels->solid.test(c) && found++ % step == 0)
            out.marks.push_back({.position = lattice.centre(lattice.place(c)),
                                 .radius = 0.4f * lattice.cell,
                                 .color = packColor(kVoxelColor),
                                 .shape = MarkShape::Square});
    out.legend.entries = {{packColor(kVoxelColor), fmt::format("voxel of {:.3g} m", lattice.cell)}};
    out.legend.notes = {fmt::format("One of {} of {} voxels, in a cube of {} along a side", step,
                                    count, lattice.size.x)};
    if (cache < lit.part->caches->caches())
        addCone(lit, cache, out);
    return out;
}

OverlayData visibilityOverlay(const LitVolume& lit, std::uint32_t cache) {
    OverlayData out;
    out.legend.title = fmt::format("Visibility from cache {}", cache);
    const std::vector<LitAreaLights> coloured = lit.coloured();
    const CacheLightInput input = lit.input(coloured);
    const CacheAllocation& caches = *lit.part->caches;
    const glm::vec3 from = caches.places[cache].position;
    std::size_t blocks = 0;
    for (const LitAreaLights& source : coloured)
        for (const AreaLightBlock& block : source.lights->blocks) {
            ++blocks;
            const glm::vec3 color = viridis(blockVisibility(input, block, caches.places[cache]));
            for (std::uint32_t j = block.begin; j < block.end; ++j) {
                const AreaLights& lights = *source.lights;
                out.marks.push_back({.position = {lights.x[j], lights.y[j], lights.z[j]},
                                     .radius = 0.8f * std::sqrt(lights.disc[j]),
                                     .normal = {lights.nx[j], lights.ny[j], lights.nz[j]},
                                     .color = packColor(color)});
            }
        }
    out.marks.push_back({.position = from,
                         .radius = kCacheScale * caches.grids.grids[gridOf(caches, cache)].cell,
                         .color = packColor(glm::vec3(1))});
    for (int k = 4; k >= 0; --k)
        out.legend.entries.push_back(
            {packColor(viridis(float(k) / 4)), fmt::format("{} % of its light", 25 * k)});
    out.legend.notes = {fmt::format("{} blocks of area lights share a cone each", blocks)};
    return out;
}

} // namespace

const Technique& VolumeSnapshot::technique() const {
    return kRadianceVolumesTechnique;
}

OverlayData VolumeSnapshot::overlay(const OverlayRequest& request, const Scene& /*scene*/,
                                    const LightSnapshot* /*light*/) const {
    const CacheAllocation& caches = *m_lit.part->caches;
    if (!request.kind || caches.caches() == 0)
        return {};
    const bool picked = request.pick < caches.caches();
    switch (request.kind - kVolumeOverlays.data()) {
    case 0:
        return picked ? lobeOverlay(*m_lit.part, request.pick) : cachesOverlay(caches);
    case 1:
        return cascadesOverlay(caches);
    case 2:
        return voxelOverlay(m_lit, request.pick);
    case 3:
        return picked ? visibilityOverlay(m_lit, request.pick) : OverlayData();
    default:
        return {};
    }
}

std::uint32_t VolumeSnapshot::pickCount() const {
    return std::uint32_t(m_lit.part->caches->caches());
}

std::optional<std::uint32_t> VolumeSnapshot::pickAt(const Scene& /*scene*/, const Hit& hit) const {
    const CacheAllocation& caches = *m_lit.part->caches;
    const CacheLookup found = lookUpCaches(caches.grids, caches.address, hit.position,
                                           hit.geometricNormal * (hit.frontFace ? 1.f : -1.f));
    if (found.count == 0)
        return {};
    const auto end = found.weight.begin() + std::ptrdiff_t(found.count);
    return found
        .cache[std::size_t(std::max_element(found.weight.begin(), end) - found.weight.begin())];
}

std::optional<std::uint32_t> VolumeSnapshot::nearestPick(const OverlaySource& other,
                                                         std::uint32_t pick) const {
    const glm::vec3 before =
        static_cast<const VolumeSnapshot&>(other).m_lit.part->caches->places[pick].position;
    const std::vector<CachePlace>& places = m_lit.part->caches->places;
    std::optional<std::uint32_t> nearest;
    float shortest = std::numeric_limits<float>::infinity();
    for (std::uint32_t c = 0; c < places.size(); ++c)
        if (const float d = glm::distance(places[c].position, before); d < shortest) {
            shortest = d;
            nearest = c;
        }
    return nearest;
}

std::vector<OverlayLine> VolumeSnapshot::describePick(const Scene& scene,
                                                      std::uint32_t pick) const {
    const VolumePart& part = *m_lit.part;
    const CacheAllocation& caches = *part.caches;
    const std::uint32_t grid = gridOf(caches, pick);
    const glm::vec3 mean =
        part.light.harmonics[pick * part.coefficients()] * std::sqrt(4 * std::numbers::pi_v<float>);
    return {{Style::Plain, fmt::format("Cache {} of {}, in cells of {:.3g} m", pick,
                                       caches.caches(), caches.grids.grids[grid].cell)},
            {Style::Plain, placeText(scene.origin, caches.places[pick].position)},
            {Style::Plain,
             fmt::format("Fluence {:.3g} {:.3g} {:.3g} W/m\u00b2", mean.x, mean.y, mean.z),
             "Red, green and blue light from all directions, each across its own"}};
}

std::vector<OverlayLine> VolumeSnapshot::describeAt(const OverlayRequest& request,
                                                    const Scene& scene, const Hit& hit,
                                                    const LightSnapshot* /*light*/) const {
    const std::optional<std::uint32_t> cache = pickAt(scene, hit);
    if (!cache)
        return {{Style::Plain, "No cache lights this point"}};
    std::vector<OverlayLine> lines = describePick(scene, *cache);
    if (!request.kind || request.kind != &kVolumeOverlays[0])
        return lines;
    const CacheAllocation& caches = *m_lit.part->caches;
    const CacheLookup found = lookUpCaches(caches.grids, caches.address, hit.position,
                                           hit.geometricNormal * (hit.frontFace ? 1.f : -1.f));
    lines.push_back({Style::Separator, ""});
    lines.push_back({Style::Heading, "Caches of this point"});
    for (std::size_t k = 0; k < found.count; ++k)
        lines.push_back({Style::Plain,
                         fmt::format("Cache {}: {:.0f} %", found.cache[k], 100 * found.weight[k])});
    return lines;
}

} // namespace limn
