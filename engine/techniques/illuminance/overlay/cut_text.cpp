// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/overlay/cut_text.h"

#include "engine/scene/origin.h"
#include "engine/techniques/illuminance/overlay/link_cut.h"
#include "engine/techniques/illuminance/overlay/overlay.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

namespace limn {

namespace {

using Style = OverlayLine::Style;

constexpr std::size_t kStrongest = 8; // links that are listed

const char* kindText(CacheKind kind) {
    switch (kind) {
    case CacheKind::Hemisphere:
        return "Lightmap texel";
    case CacheKind::Grid:
        return "Grid cell";
    }
    return "";
}

std::string senderText(const ClusterTree& tree, const LinkedNode& n) {
    if (n.node < tree.surfels)
        return fmt::format("surfel {}", n.node);
    if (n.node >= tree.leaves())
        return fmt::format("cluster of {}", n.leaves);
    const glm::vec3 d = tree.skyDirection[n.node - tree.surfels];
    const float up = glm::degrees(std::asin(std::clamp(d.y, -1.f, 1.f)));
    const float around = glm::degrees(std::atan2(d.x, -d.z));
    return fmt::format("{:.0f}\u00b0 up, {:.0f}\u00b0 around", up, around);
}

// The strongest senders of the surfaces, or of the sky.
void addSenders(const ClusterTree& tree, const LinkCut& cut, bool sky,
                std::vector<OverlayLine>& lines) {
    std::size_t count = 0;
    for (const LinkedNode& n : cut.nodes) {
        const bool isSky = n.node >= tree.surfels && n.node < tree.leaves();
        if (isSky == sky && count++ < kStrongest)
            lines.push_back(
                {Style::Plain, fmt::format("{:5.2f} %  {}", 100 * double(n.weight) / cut.total,
                                           senderText(tree, n))});
    }
    if (count == 0)
        lines.push_back({Style::Heading, "none"});
    else if (count > kStrongest)
        lines.push_back({Style::Heading, fmt::format("and {} more", count - kStrongest)});
}

void addFill(const LinkCut& cut, std::vector<OverlayLine>& lines) {
    lines.push_back({Style::Heading, "Filled from"});
    for (std::size_t k = 0; k < std::min(cut.filledFrom.size(), kStrongest); ++k)
        lines.push_back({Style::Plain,
                         fmt::format("{:5.1f} %  cache {}", 100 * double(cut.filledFrom[k].second),
                                     cut.filledFrom[k].first)});
    if (cut.filledFrom.empty())
        lines.push_back({Style::Plain, "none: it is black"});
}

} // namespace

std::vector<OverlayLine> describeCut(const Bake& bake, const Scene& scene, std::uint32_t cache) {
    const Caches& caches = bake.caches;
    const LinkCut cut = linkCut(bake, cache);
    const bool valid = isValid(caches, cache);
    std::vector<OverlayLine> lines = {
        {Style::Separator, ""},
        {Style::Plain,
         fmt::format("{}, {}", kindText(caches.kind[cache]), valid ? "valid" : "invalid")},
        {Style::Plain, placeText(scene.origin, caches.position[cache])}};
    if (!valid) {
        addFill(cut, lines);
        return lines;
    }
    lines.push_back({Style::Plain,
                     fmt::format("{} links, {:.3g} sr seen",
                                 caches.linkBegin[cache + 1] - caches.linkBegin[cache],
                                 cut.total * std::numbers::pi),
                     "Visible solid angle of all its senders [sr]: a hemisphere has 6.28, a whole "
                     "sphere 12.6"});
    lines.push_back({Style::Separator, ""});
    lines.push_back({Style::Heading, "Strongest surfels and clusters",
                     "Share of the cache's view, and how many surfels the cluster holds"});
    addSenders(bake.tree, cut, false, lines);
    lines.push_back({Style::Heading, "Strongest sky cells",
                     "Share of the cache's view, and the cell's direction: degrees above the "
                     "horizon, and around from -Z towards +X"});
    addSenders(bake.tree, cut, true, lines);
    return lines;
}

} // namespace limn
