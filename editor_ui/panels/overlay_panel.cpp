// SPDX-License-Identifier: MIT
#include "editor_ui/panels/overlay_panel.h"

#include "editor_ui/panels/field.h"
#include "editor_ui/panels/theme.h"
#include "editor_ui/view/picking.h"
#include "engine/techniques/technique_table.h"

#include <imgui.h>

#include <algorithm>

namespace limn {

void pickCache(OverlayState& overlay, std::uint32_t cache) {
    const bool known = overlay.bake && cache < overlay.bake->pickCount();
    overlay.options.pick = known ? cache : ~0u;
    overlay.picked.clear();
    if (known)
        overlay.picked = overlay.bake->describePick(*overlay.scene, cache);
}

void setOverlayBake(OverlayState& overlay, std::shared_ptr<const Precomputed> bake,
                    std::shared_ptr<const Scene> scene) {
    std::uint32_t picked = ~0u;
    if (const std::uint32_t old = overlay.options.pick; overlay.bake && bake && old != ~0u)
        if (&overlay.bake->technique() == &bake->technique())
            picked = bake->nearestPick(*overlay.bake, old).value_or(~0u);
    overlay.bake = std::move(bake);
    overlay.scene = std::move(scene);
    overlay.maxDepth = overlay.bake ? overlay.bake->maxOverlayDepth() : 0;
    pickCache(overlay, picked);
}

void pickCacheAt(EditorState& state, glm::vec2 mouse) {
    OverlayState& overlay = state.overlay;
    Hit hit = overlay.bake ? hitUnder(state, mouse) : Hit{};
    if (!hit)
        return;
    const Instance& seen = state.trace->scene().instances[hit.instance];
    const auto& baked = overlay.scene->instances;
    const auto same = std::ranges::find_if(
        baked, [&](const Instance& i) { return i.node == seen.node && i.mesh == seen.mesh; });
    // An instance unknown to the bake gets the number past the end: it is lit from the grid.
    hit.instance = std::uint32_t(same - baked.begin());
    if (const auto cache = overlay.bake->pickAt(*overlay.scene, hit))
        pickCache(overlay, *cache);
}

void overlayCombo(EditorState& state, float width) {
    const OverlayKind*& shown = state.overlay.options.kind;
    ImGui::SetNextItemWidth(width);
    const bool open = ImGui::BeginCombo("##overlay", shown ? shown->label : kNoOverlay.label,
                                        ImGuiComboFlags_HeightLargest);
    if (!open) {
        wrappedTooltip("Part of the bake that is drawn over the picture");
        return;
    }
    const auto entry = [&](const OverlayKind& text, const OverlayKind* kind) {
        if (ImGui::Selectable(text.label, shown == kind))
            shown = kind;
        wrappedTooltip(text.tooltip);
    };
    entry(kNoOverlay, nullptr);
    for (const OverlayKind* kind : overlayKinds())
        entry(*kind, kind);
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
    ImGui::PushStyleColor(ImGuiCol_Text, color::dim());
    for (const std::string& note : legend.notes)
        ImGui::TextWrapped("%s", note.c_str());
    ImGui::PopStyleColor();
}

static void depthRow(OverlayState& overlay) {
    const std::uint32_t least = 0;
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::SliderScalar("##depth", ImGuiDataType_U32, &overlay.options.depth, &least,
                        &overlay.maxDepth, "Depth %u", ImGuiSliderFlags_AlwaysClamp);
    wrappedTooltip("How many steps below the tree's root the clusters lie; 0: the root. "
                   "Ctrl-click to type");
}

static void cacheRow(OverlayState& overlay) {
    int cache = int(overlay.options.pick); // ~0 is -1
    fieldLabel("Cache", "Number of the cache shown; click a surface in the picture to pick the one "
                        "that lights it");
    if (ImGui::InputInt("##cache", &cache, 1, 100))
        pickCache(overlay,
                  std::uint32_t(std::clamp(cache, -1, int(overlay.bake->pickCount()) - 1)));
    wrappedTooltip("Number of the cache shown; -1: none picked. Lightmap texels first, then the "
                   "grid's cells");
}

static void lineRow(const OverlayLine& line) {
    switch (line.style) {
    case OverlayLine::Style::Plain:
        ImGui::TextUnformatted(line.text.c_str());
        break;
    case OverlayLine::Style::Heading:
        ImGui::TextDisabled("%s", line.text.c_str());
        break;
    case OverlayLine::Style::Separator:
        ImGui::Separator();
        return;
    }
    if (*line.tooltip)
        wrappedTooltip(line.tooltip);
}

void overlayPanel(EditorState& state) {
    OverlayState& overlay = state.overlay;
    const OverlayKind& kind = *overlay.options.kind;
    ImGui::TextUnformatted(overlay.legend.title.empty() ? kind.label
                                                        : overlay.legend.title.c_str());
    wrappedTooltip(kind.tooltip);
    ImGui::Separator();
    if (!overlay.bake) {
        ImGui::TextColored(ImColor(color::warning()), "Nothing baked yet");
        return;
    }
    if (kind.hasDepth)
        depthRow(overlay);
    if (kind.pick != OverlayPick::None)
        cacheRow(overlay);
    legendRows(overlay.legend);
    if (kind.describesPick)
        for (const OverlayLine& line : overlay.picked)
            lineRow(line);
}

} // namespace limn
