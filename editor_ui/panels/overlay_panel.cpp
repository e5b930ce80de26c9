// SPDX-License-Identifier: MIT
#include "editor_ui/panels/overlay_panel.h"

#include "editor_ui/panels/bar_combo.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/theme.h"
#include "editor_ui/view/picking.h"
#include "engine/techniques/technique_table.h"

#include <imgui.h>

#include <algorithm>

namespace limn {

void pickNumber(OverlayState& overlay, std::uint32_t number) {
    const bool known = overlay.source && number < overlay.source->pickCount();
    overlay.options.pick = known ? number : ~0u;
    overlay.picked.clear();
    if (known)
        overlay.picked = overlay.source->describePick(*overlay.scene, number);
}

void setOverlaySource(OverlayState& overlay, std::shared_ptr<const OverlaySource> source,
                      std::shared_ptr<const Scene> scene) {
    std::uint32_t picked = ~0u;
    if (const std::uint32_t old = overlay.options.pick; overlay.source && source && old != ~0u)
        if (&overlay.source->technique() == &source->technique())
            picked = source->nearestPick(*overlay.source, old).value_or(~0u);
    overlay.source = std::move(source);
    overlay.scene = std::move(scene);
    overlay.maxDepth = overlay.source ? overlay.source->maxOverlayDepth() : 0;
    pickNumber(overlay, picked);
}

void pickAt(EditorState& state, glm::vec2 mouse) {
    OverlayState& overlay = state.overlay;
    Hit hit = overlay.source ? hitUnder(state, mouse) : Hit{};
    if (!hit)
        return;
    const Instance& seen = state.trace->scene().instances[hit.instance];
    const auto& known = overlay.scene->instances;
    const auto same = std::ranges::find_if(
        known, [&](const Instance& i) { return i.node == seen.node && i.mesh == seen.mesh; });
    // An instance unknown to a bake gets the number past the end: it is lit from the grid.
    hit.instance = std::uint32_t(same - known.begin());
    if (const auto number = overlay.source->pickAt(*overlay.scene, hit))
        pickNumber(overlay, *number);
}

void overlayCombo(EditorState& state, float width) {
    const OverlayKind*& shown = state.overlay.options.kind;
    if (!beginBarCombo("##overlay", shown ? shown->label : kNoOverlay.label,
                       "What a technique computed, drawn over the picture", width))
        return;
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

static void pickRow(OverlayState& overlay) {
    const OverlayKind& kind = *overlay.options.kind;
    int number = int(overlay.options.pick); // ~0 is -1
    fieldLabel(kind.picked, "Number of what is picked; click a surface in the picture to pick what "
                            "lights it");
    if (ImGui::InputInt("##pick", &number, 1, 100))
        pickNumber(overlay,
                   std::uint32_t(std::clamp(number, -1, int(overlay.source->pickCount()) - 1)));
    wrappedTooltip(kind.pickedTooltip);
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
    if (!isMadeOf(kind, overlay.source.get())) {
        const Technique& technique = techniqueOf(kind);
        ImGui::PushStyleColor(ImGuiCol_Text, color::warning());
        if (technique.precomputation)
            ImGui::TextUnformatted("Nothing baked yet");
        else
            ImGui::TextWrapped("Shown while the technique is \"%s\"", technique.label);
        ImGui::PopStyleColor();
        return;
    }
    if (kind.hasDepth)
        depthRow(overlay);
    if (kind.pick != OverlayPick::None)
        pickRow(overlay);
    legendRows(overlay.legend);
    if (kind.describesPick)
        for (const OverlayLine& line : overlay.picked)
            lineRow(line);
}

} // namespace limn
