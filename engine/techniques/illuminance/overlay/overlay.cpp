// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/overlay/overlay.h"

#include "engine/core/parallel.h"
#include "engine/overlay/palette.h"
#include "engine/techniques/illuminance/overlay/light_overlay.h"
#include "engine/techniques/illuminance/overlay/link_cut.h"
#include "engine/techniques/illuminance/overlay/texel_overlay.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <span>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

namespace {

// Discs and squares of the full area of a surfel or texel would hide the surface and one another,
// so their radius and side are scaled by these factors.
constexpr float kSurfelScale = 0.6f, kTexelScale = 0.3f;

const glm::vec3 kValidTexel(0.13f, 0.57f, 0.9f), kValidCell(0.95f, 0.85f, 0.3f), kInvalid(1, 0, 1),
    kUnlinked(0.25f, 0.25f, 0.27f);

} // namespace

static std::vector<std::uint32_t> depths(const ClusterTree& tree) {
    std::vector<std::uint32_t> depth(tree.size(), 0);
    for (std::uint32_t n = tree.size(); n-- > 0;) // parents come after their children
        if (tree.parent[n] != ~0u)
            depth[n] = depth[tree.parent[n]] + 1;
    return depth;
}

std::uint32_t treeDepth(const ClusterTree& tree) {
    std::uint32_t deepest = 0;
    for (const std::uint32_t d : depths(tree))
        deepest = std::max(deepest, d);
    return deepest;
}

std::vector<std::uint32_t> clustersAtDepth(const ClusterTree& tree, std::uint32_t depth) {
    const std::vector<std::uint32_t> depthOf = depths(tree);
    std::vector<std::uint32_t> cluster(tree.size());
    for (std::uint32_t n = tree.size(); n-- > 0;)
        cluster[n] = depthOf[n] <= depth ? n : cluster[tree.parent[n]];
    cluster.resize(tree.leaves());
    return cluster;
}

// One disc per surfel; `colorOf` is asked for each surfel's sRGB colour, from many threads.
template <class ColorOf>
static std::vector<OverlayMark> surfelMarks(const Surfels& surfels, const ColorOf& colorOf) {
    std::vector<OverlayMark> marks(surfels.size());
    parallelRanges(marks.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            OverlayMark& m = marks[i];
            m.position = surfels.position[i];
            m.normal = surfels.normal[i];
            m.radius = kSurfelScale * std::sqrt(surfels.area[i] / std::numbers::pi_v<float>);
            m.color = packColor(colorOf(std::uint32_t(i)));
        }
    });
    return marks;
}

std::vector<OverlayMark> surfelMarks(const Surfels& surfels, const std::vector<glm::vec3>& colors) {
    return surfelMarks(surfels, [&](std::uint32_t i) { return colors[i]; });
}

static std::string sizeNote(const Surfels& surfels) {
    double area = 0;
    for (const float a : surfels.area)
        area += double(a);
    return fmt::format("{} surfels, {:.3g} m² each on average; discs have {:.0f} % of a surfel's "
                       "area",
                       surfels.size(), area / double(std::max<std::size_t>(surfels.size(), 1)),
                       100 * kSurfelScale * kSurfelScale);
}

static OverlayData surfelOverlay(const Bake& bake, const Scene& scene) {
    const Surfels& s = bake.surfels;
    OverlayData out;
    out.marks = surfelMarks(s, [&](std::uint32_t i) {
        return encodeSrgb(surfaceMaterial(scene, scene.instances[s.instance[i]], s.triangle[i],
                                          s.barycentric[i].x, s.barycentric[i].y)
                              .albedo);
    });
    out.legend = {"Surfels: albedo", {}, {"Disc: the surface's own albedo there", sizeNote(s)}};
    return out;
}

static OverlayData normalOverlay(const Bake& bake) {
    OverlayData out;
    const auto color = [](glm::vec3 n) { return n * 0.5f + 0.5f; };
    out.marks =
        surfelMarks(bake.surfels, [&](std::uint32_t i) { return color(bake.surfels.normal[i]); });
    out.legend.title = "Surfels: normal";
    const std::array<std::pair<glm::vec3, const char*>, 6> axes = {{{{1, 0, 0}, "faces +X"},
                                                                    {{-1, 0, 0}, "faces -X"},
                                                                    {{0, 1, 0}, "faces +Y, up"},
                                                                    {{0, -1, 0}, "faces -Y, down"},
                                                                    {{0, 0, 1}, "faces +Z"},
                                                                    {{0, 0, -1}, "faces -Z"}}};
    for (const auto& [n, text] : axes)
        out.legend.entries.push_back({packColor(color(n)), text});
    out.legend.notes.push_back(sizeNote(bake.surfels));
    return out;
}

static OverlayData ownerOverlay(const Bake& bake, const Scene& scene) {
    OverlayData out;
    const Surfels& s = bake.surfels;
    out.marks = surfelMarks(s, [&](std::uint32_t i) { return distinctColor(s.instance[i]); });
    const std::set<std::uint32_t> owners(s.instance.begin(), s.instance.end());
    out.legend = {"Surfels: owner",
                  {},
                  {fmt::format("One colour per instance; {} of {} instances own surfels",
                               owners.size(), scene.instances.size()),
                   sizeNote(s)}};
    return out;
}

static OverlayData clusterOverlay(const Bake& bake, std::uint32_t depth) {
    OverlayData out;
    const std::vector<std::uint32_t> cluster = clustersAtDepth(bake.tree, depth);
    out.marks =
        surfelMarks(bake.surfels, [&](std::uint32_t i) { return distinctColor(cluster[i]); });
    const auto skyBegin = cluster.begin() + bake.tree.surfels;
    std::set<std::uint32_t> all(cluster.begin(), skyBegin), sky(skyBegin, cluster.end());
    out.legend = {
        fmt::format("Clusters at depth {} of {}", depth, treeDepth(bake.tree)),
        {},
        {fmt::format("One colour per cluster; {} hold surfels, {:.1f} each on average", all.size(),
                     double(bake.tree.surfels) / double(std::max<std::size_t>(all.size(), 1))),
         fmt::format("{} more hold {} sky cells", sky.size(), bake.tree.skyCells)}};
    return out;
}

static float gridSpacing(const Bake& bake) {
    const glm::vec3 cell = bake.gridBounds.size() / glm::vec3(glm::max(bake.gridSize, 1u));
    return std::min({cell.x, cell.y, cell.z});
}

struct TexelRadii {
    std::vector<float> radius;
    std::uint32_t surfelCaches = 0; ///< number of surfel caches, which only surfels read
};

// Half the side of the square of surface that each lightmap texel stands for [m]; half the mean of
// that for texels that no lookup needs.
static TexelRadii texelRadii(const Bake& bake, const Scene& scene) {
    TexelRadii out{texelUse(bake.lightmap, scene).density};
    double sum = 0;
    std::uint32_t used = 0;
    for (float& r : out.radius) {
        r = r > 0 ? 0.5f / r : 0;
        sum += double(r);
        used += r > 0 ? 1 : 0;
    }
    for (std::uint32_t c = 0; c < bake.caches.lightmapCount; ++c)
        if (float& r = out.radius[bake.caches.texel[c]]; r == 0) {
            r = float(0.5 * sum / std::max(used, 1U));
            ++out.surfelCaches;
        }
    return out;
}

static OverlayMark cacheMark(const Bake& bake, std::uint32_t c, std::span<const float> radii) {
    const Caches& caches = bake.caches;
    const bool grid = caches.kind[c] == CacheKind::Grid;
    OverlayMark m;
    m.position = caches.position[c];
    m.normal = caches.normal[c];
    m.radius = grid ? 0.1f * gridSpacing(bake) : kTexelScale * radii[caches.texel[c]];
    m.shape = grid ? MarkShape::Disc : MarkShape::Square;
    m.color = packColor(!isValid(caches, c) ? kInvalid : grid ? kValidCell : kValidTexel);
    return m;
}

static OverlayData cacheOverlay(const Bake& bake, const Scene& scene) {
    OverlayData out;
    const auto count = std::uint32_t(bake.caches.size());
    const TexelRadii radii = texelRadii(bake, scene);
    std::uint32_t invalidTexels = 0, invalidCells = 0;
    for (std::uint32_t c = 0; c < count; ++c) {
        out.marks.push_back(cacheMark(bake, c, radii.radius));
        if (!isValid(bake.caches, c))
            ++(c < bake.caches.lightmapCount ? invalidTexels : invalidCells);
    }
    const std::uint32_t texels = bake.caches.lightmapCount, cells = count - texels;
    out.legend.title = "Caches";
    out.legend.entries = {
        {packColor(kValidTexel), fmt::format("square: lightmap texel, {}", texels - invalidTexels)},
        {packColor(kValidCell), fmt::format("dot: grid cell, {}", cells - invalidCells)},
        {packColor(kInvalid), fmt::format("invalid, filled from others: {} texels, {} cells",
                                          invalidTexels, invalidCells)}};
    out.legend.notes = {fmt::format("Squares have {:.0f} % of the side of what a texel stands for",
                                    100 * kTexelScale)};
    if (radii.surfelCaches > 0)
        out.legend.notes.push_back(fmt::format(
            "Those of half the size, {}, are read by surfels alone", radii.surfelCaches));
    if (cells > 0)
        out.legend.notes.push_back(
            fmt::format("Grid cells are {:.3g} m apart", double(gridSpacing(bake))));
    return out;
}

static OverlayLegend linkLegend(const Bake& bake, const LinkCut& cut, float minWeight) {
    OverlayLegend legend{fmt::format("Link cut of cache {}", cut.cache), {}, {}};
    if (cut.nodes.empty()) {
        legend.notes = {
            fmt::format("Invalid: no links; filled from {} caches", cut.filledFrom.size())};
        return legend;
    }
    const float maxWeight = cut.nodes.front().weight;
    for (int k = 4; k >= 0; --k) {
        const float t = float(k) / 4, weight = minWeight * std::pow(maxWeight / minWeight, t);
        legend.entries.push_back(
            {packColor(viridis(t)),
             fmt::format("{:.3g} % of its view", 100 * double(weight) / cut.total)});
    }
    legend.entries.push_back({packColor(kUnlinked), "not linked"});
    const auto isSky = [&](const LinkedNode& n) {
        return n.node >= bake.tree.surfels && n.node < bake.tree.leaves();
    };
    double skyWeight = 0;
    for (std::uint32_t leaf = bake.tree.surfels; leaf < bake.tree.leaves(); ++leaf)
        skyWeight += double(cut.leafWeight[leaf]);
    legend.notes = {
        fmt::format("Colour: weight of the linked cluster a surfel belongs to, logarithmic"),
        fmt::format("{} links to {} senders, {} of them sky cells; the sky is {:.1f} % of its view",
                    bake.caches.linkBegin[cut.cache + 1] - bake.caches.linkBegin[cut.cache],
                    cut.nodes.size(), std::ranges::count_if(cut.nodes, isSky),
                    100 * skyWeight / cut.total)};
    return legend;
}

static OverlayData linkOverlay(const Bake& bake, const Scene& scene, std::uint32_t cache) {
    OverlayData out;
    if (cache >= bake.caches.size()) {
        out.legend = {"Link cut", {}, {"No cache picked: click a surface"}};
        return out;
    }
    const LinkCut cut = linkCut(bake, cache);
    float maxWeight = 0, minWeight = 1e30f;
    for (const LinkedNode& n : cut.nodes)
        if (n.weight > 0)
            maxWeight = std::max(maxWeight, n.weight), minWeight = std::min(minWeight, n.weight);
    minWeight = std::max(std::min(minWeight, 0.5f * maxWeight), 1e-4f * maxWeight);
    const float octaves = maxWeight > 0 ? std::log(maxWeight / minWeight) : 1;
    out.marks = surfelMarks(bake.surfels, [&](std::uint32_t i) {
        const float w = cut.nodeWeight[i];
        return w > 0 ? viridis(std::log(w / minWeight) / octaves) : kUnlinked;
    });
    OverlayMark ring = cacheMark(bake, cache, texelRadii(bake, scene).radius);
    ring.radius *= 1.5f;
    ring.shape = MarkShape::Ring;
    out.marks.push_back(ring);
    out.legend = linkLegend(bake, cut, minWeight);
    return out;
}

OverlayData makeOverlay(const Bake& bake, const Scene& scene, const OverlayOptions& options,
                        const LitBake* lit) {
    switch (options.kind) {
    case Overlay::None:
        return {};
    case Overlay::Surfels:
        return surfelOverlay(bake, scene);
    case Overlay::SurfelNormals:
        return normalOverlay(bake);
    case Overlay::SurfelOwners:
        return ownerOverlay(bake, scene);
    case Overlay::Clusters:
        return clusterOverlay(bake, options.depth);
    case Overlay::Links:
        return linkOverlay(bake, scene, options.cache);
    case Overlay::Caches:
        return cacheOverlay(bake, scene);
    case Overlay::Charts:
    case Overlay::Density:
    case Overlay::Overlap:
        return texelOverlay(bake, scene, options.kind);
    case Overlay::LitSurfels:
    case Overlay::LitClusters:
    case Overlay::Dependencies:
    case Overlay::Lobes:
        return lightOverlay(bake, scene, options, lit);
    }
    return {};
}

} // namespace limn
