// SPDX-License-Identifier: MIT
#include "editor_ui/panels/overlay_panel.h"

#include "editor_ui/panels/field.h"
#include "editor_ui/panels/theme.h"
#include "engine/scene/origin.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace limn {

static constexpr std::size_t kStrongest = 8; // links that are listed

void pickCache(OverlayState& overlay, std::uint32_t cache) {
    const bool known = overlay.bake && cache < overlay.bake->caches.size();
    overlay.options.cache = known ? cache : ~0u;
    overlay.cut.reset();
    if (known)
        overlay.cut = linkCut(*overlay.bake, cache);
}

// The cache of the same kind nearest to a place.
static std::uint32_t nearestCache(const Caches& caches, CacheKind kind, glm::vec3 place) {
    std::uint32_t nearest = ~0u;
    float best = std::numeric_limits<float>::max();
    for (std::uint32_t c = 0; c < caches.size(); ++c)
        if (const float d = glm::distance(caches.position[c], place);
            caches.kind[c] == kind && d < best)
            nearest = c, best = d;
    return nearest;
}

void setOverlayBake(OverlayState& overlay, std::shared_ptr<const Bake> bake,
                    std::shared_ptr<const Scene> scene) {
    std::uint32_t picked = ~0u;
    if (const std::uint32_t old = overlay.options.cache; overlay.bake && bake && old != ~0u)
        picked = nearestCache(bake->caches, overlay.bake->caches.kind[old],
                              overlay.bake->caches.position[old]);
    overlay.bake = std::move(bake);
    overlay.scene = std::move(scene);
    overlay.treeDepth = overlay.bake ? treeDepth(overlay.bake->tree) : 0;
    pickCache(overlay, picked);
}

void pickCacheAt(EditorState& state, glm::vec2 mouse) {
    OverlayState& overlay = state.overlay;
    if (!state.trace || !overlay.bake)
        return;
    const Picture picture = state.view.picture();
    Hit hit = state.trace->closestHit({picture.camera.eye, pixelDirection(picture, mouse)});
    if (!hit)
        return;
    const Instance& seen = state.trace->scene().instances[hit.instance];
    const auto& baked = overlay.scene->instances;
    const auto same = std::ranges::find_if(
        baked, [&](const Instance& i) { return i.node == seen.node && i.mesh == seen.mesh; });
    // An instance unknown to the bake gets the number past the end: it is lit from the grid.
    hit.instance = std::uint32_t(same - baked.begin());
    if (const auto cache = cacheAt(*overlay.bake, *overlay.scene, hit))
        pickCache(overlay, *cache);
}

void overlayCombo(EditorState& state) {
    OverlayOptions& options = state.overlay.options;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 9);
    const bool open = ImGui::BeginCombo("##overlay", kOverlays[std::size_t(options.kind)].label,
                                        ImGuiComboFlags_HeightLargest);
    if (!open)
        wrappedTooltip("What of the bake is drawn over the picture");
    for (std::size_t k = 0; open && k < kOverlays.size(); ++k) {
        const bool chosen = std::size_t(options.kind) == k;
        if (ImGui::Selectable(kOverlays[k].label, chosen))
            options.kind = Overlay(k);
        wrappedTooltip(kOverlays[k].tooltip);
    }
    if (open)
        ImGui::EndCombo();
}

static void legendRows(const OverlayLegend& legend) {
    const float side = ImGui::GetTextLineHeight();
    for (const OverlayLegend::Entry& entry : legend.entries) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        // ImGui's colours are packed the same way.
        ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 2}, {at.x + side, at.y + side - 1},
                                                  entry.color, 2);
        ImGui::Dummy({side, side});
        ImGui::SameLine();
        ImGui::TextUnformatted(entry.text.c_str());
    }
    ImGui::PushStyleColor(ImGuiCol_Text, color::kDim);
    for (const std::string& note : legend.notes)
        ImGui::TextWrapped("%s", note.c_str());
    ImGui::PopStyleColor();
}

static void depthRow(OverlayState& overlay) {
    const std::uint32_t least = 0;
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::SliderScalar("##depth", ImGuiDataType_U32, &overlay.options.depth, &least,
                        &overlay.treeDepth, "Depth %u", ImGuiSliderFlags_AlwaysClamp);
    wrappedTooltip("How many steps below the tree's root the clusters lie; 0: the root. "
                   "Ctrl-click to type");
}

static void cacheRow(OverlayState& overlay) {
    int cache = overlay.cut ? int(overlay.cut->cache) : -1;
    fieldLabel("Cache", "Number of the cache shown; click a surface in the picture to pick the one "
                        "that lights it");
    if (ImGui::InputInt("##cache", &cache, 1, 100))
        pickCache(overlay,
                  std::uint32_t(std::clamp(cache, -1, int(overlay.bake->caches.size()) - 1)));
    wrappedTooltip("Number of the cache shown; -1: none picked. Lightmap texels first, then the "
                   "grid's cells");
}

static const char* kindText(CacheKind kind) {
    switch (kind) {
    case CacheKind::Hemisphere:
        return "Lightmap texel";
    case CacheKind::Grid:
        return "Grid cell";
    }
    return "";
}

static std::string senderText(const ClusterTree& tree, const LinkedNode& n) {
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
static void senderRows(const OverlayState& overlay, bool sky) {
    const ClusterTree& tree = overlay.bake->tree;
    std::size_t count = 0;
    for (const LinkedNode& n : overlay.cut->nodes) {
        const bool isSky = n.node >= tree.surfels && n.node < tree.leaves();
        if (isSky == sky && count++ < kStrongest)
            ImGui::Text("%5.2f %%  %s", 100 * double(n.weight) / overlay.cut->total,
                        senderText(tree, n).c_str());
    }
    if (count == 0)
        ImGui::TextDisabled("none");
    else if (count > kStrongest)
        ImGui::TextDisabled("and %zu more", count - kStrongest);
}

static void fillRows(const LinkCut& cut) {
    ImGui::TextDisabled("Filled from");
    for (std::size_t k = 0; k < std::min(cut.filledFrom.size(), kStrongest); ++k)
        ImGui::Text("%5.1f %%  cache %u", 100 * double(cut.filledFrom[k].second),
                    cut.filledFrom[k].first);
    if (cut.filledFrom.empty())
        ImGui::TextUnformatted("none: it is black");
}

static void cutRows(const OverlayState& overlay) {
    if (!overlay.cut)
        return;
    ImGui::Separator();
    const Caches& caches = overlay.bake->caches;
    const LinkCut& cut = *overlay.cut;
    const bool valid = isValid(caches, cut.cache);
    ImGui::Text("%s, %s", kindText(caches.kind[cut.cache]), valid ? "valid" : "invalid");
    const glm::dvec3& origin = overlay.scene->origin;
    const glm::dvec3 p = toFile(origin, caches.position[cut.cache]);
    // Three significant digits distinguish positions only near the origin.
    ImGui::Text(origin == glm::dvec3(0) ? "At %.3g, %.3g, %.3g m" : "At %.3f, %.3f, %.3f m", p.x,
                p.y, p.z);
    if (!valid) {
        fillRows(cut);
        return;
    }
    ImGui::Text("%u links, %.3g sr seen",
                caches.linkBegin[cut.cache + 1] - caches.linkBegin[cut.cache],
                cut.total * 3.14159265358979);
    wrappedTooltip("Visible solid angle of all its senders [sr]: a hemisphere has 6.28, a whole "
                   "sphere 12.6");
    ImGui::Separator();
    ImGui::TextDisabled("Strongest surfels and clusters");
    wrappedTooltip("Share of the cache's view, and how many surfels the cluster holds");
    senderRows(overlay, false);
    ImGui::TextDisabled("Strongest sky cells");
    wrappedTooltip("Share of the cache's view, and the cell's direction: degrees above the "
                   "horizon, and around from -Z towards +X");
    senderRows(overlay, true);
}

void overlayPanel(EditorState& state) {
    OverlayState& overlay = state.overlay;
    const OverlayName& name = kOverlays[std::size_t(overlay.options.kind)];
    ImGui::TextUnformatted(overlay.legend.title.empty() ? name.label
                                                        : overlay.legend.title.c_str());
    wrappedTooltip(name.tooltip);
    ImGui::Separator();
    if (!overlay.bake) {
        ImGui::TextColored(ImColor(color::kWarning), "Nothing baked yet");
        return;
    }
    if (hasDepth(overlay.options.kind))
        depthRow(overlay);
    if (hasCache(overlay.options.kind))
        cacheRow(overlay);
    legendRows(overlay.legend);
    if (overlay.options.kind == Overlay::Links)
        cutRows(overlay);
}

} // namespace limn
