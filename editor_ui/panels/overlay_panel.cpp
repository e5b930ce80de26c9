// SPDX-License-Identifier: MIT
#include "editor_ui/panels/overlay_panel.h"

#include "editor_ui/panels/bar_combo.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/picture_label.h"
#include "editor_ui/panels/theme.h"
#include "editor_ui/view/picking.h"
#include "engine/techniques/technique_table.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

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

/// The surface under the mouse, with its instance as the overlay's scene numbers it. Nothing is hit
/// without an overlay's source.
static Hit hitOfOverlay(const EditorState& state, glm::vec2 mouse) {
    const OverlayState& overlay = state.overlay;
    Hit hit = overlay.source ? hitUnder(state, mouse) : Hit{};
    if (!hit)
        return hit;
    const Instance& seen = state.trace->scene().instances[hit.instance];
    const auto& known = overlay.scene->instances;
    const auto same = std::ranges::find_if(
        known, [&](const Instance& i) { return i.node == seen.node && i.mesh == seen.mesh; });
    // An instance unknown to a bake gets the number past the end: it is lit from the grid.
    hit.instance = std::uint32_t(same - known.begin());
    return hit;
}

void pickAt(EditorState& state, glm::vec2 mouse) {
    OverlayState& overlay = state.overlay;
    if (const Hit hit = hitOfOverlay(state, mouse))
        if (const auto number = overlay.source->pickAt(*overlay.scene, hit))
            pickNumber(overlay, *number);
}

/// Picks what lights one of the first triangles of the node's mesh.
static void pickObject(EditorState& state, ObjectId node) {
    constexpr std::size_t kTriangles = 64;
    OverlayState& overlay = state.overlay;
    const Scene& scene = *overlay.scene;
    const PickedSurface* clicked = pickedSurface(state);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (instance.node != node || (clicked && clicked->mesh != instance.mesh))
            continue;
        const Mesh& mesh = scene.meshOf(instance);
        for (std::size_t t = 0; t < std::min(mesh.triangleCount(), kTriangles); ++t) {
            const auto [a, b, c] = mesh.triangle(t);
            const glm::vec3 centre =
                (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.f;
            const Hit hit{{.instance = i, .triangle = std::uint32_t(t), .u = 1 / 3.f, .v = 1 / 3.f},
                          instance.toWorld * glm::vec4(centre, 1)};
            if (const auto number = overlay.source->pickAt(scene, hit)) {
                pickNumber(overlay, *number);
                return;
            }
        }
    }
}

void followSelection(EditorState& state) {
    OverlayState& overlay = state.overlay;
    const OverlayKind* kind = overlay.options.kind;
    if (!kind || !kind->ofObject || !isMadeOf(*kind, overlay.source.get())) {
        overlay.followed = 0;
        return;
    }
    const ObjectId active = activeId(state);
    if (active == overlay.followed)
        return;
    overlay.followed = active;
    pickObject(state, active);
}

static std::string joined(const std::vector<OverlayLine>& lines) {
    std::string text;
    for (const OverlayLine& line : lines)
        if (line.style != OverlayLine::Style::Separator)
            text += (text.empty() ? "" : "\n") + line.text;
    return text;
}

void overlayNumbers(EditorState& state) {
    OverlayState& overlay = state.overlay;
    if (!overlay.options.kind || !isMadeOf(*overlay.options.kind, overlay.source.get()))
        return;
    const ImVec2 cursor = ImGui::GetIO().MousePos;
    const glm::vec2 mouse(cursor.x, cursor.y);
    OverlayHover& hover = overlay.hover;
    if (hover.mouse != mouse || hover.camera != state.view.camera ||
        hover.options != overlay.options || hover.source != overlay.source ||
        hover.light != overlay.light) {
        const Hit hit = hitOfOverlay(state, mouse);
        hover = {mouse, state.view.camera, overlay.options, overlay.source, overlay.light, {}};
        if (hit)
            hover.text = joined(overlay.source->describeAt(overlay.options, *overlay.scene, hit,
                                                           overlay.light.get()));
    }
    if (hover.text.empty())
        return;
    const glm::vec2 middle = state.view.origin + state.view.size / 2.f;
    const ImVec2 align(mouse.x > middle.x ? 1.f : 0.f, mouse.y > middle.y ? 1.f : 0.f);
    const float away = std::round(ImGui::GetFontSize());
    pictureLabel({cursor.x + (align.x > 0 ? -away : away), cursor.y + (align.y > 0 ? -away : away)},
                 align, hover.text, IM_COL32_WHITE, 0, {.margin = {8, 4}});
}

void overlayCombo(EditorState& state, float width) {
    const OverlayKind*& shown = state.overlay.options.kind;
    if (!beginBarCombo("##overlay", shown ? shown->label : kNoOverlay.label,
                       "What a technique computed, drawn over the picture", width))
        return;
    const auto entry = [&](const OverlayKind& text, const OverlayKind* kind) {
        ImGui::PushID(text.name); // labels need not be unique among techniques
        if (ImGui::Selectable(text.label, shown == kind))
            shown = kind;
        ImGui::PopID();
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
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        // ImGui's colours are packed the same way.
        ImGui::GetWindowDrawList()->AddRectFilled(
            {corner.x, corner.y + 2}, {corner.x + side, corner.y + side - 1}, entry.color, 2);
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
    const std::uint32_t minDepth = 0;
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::SliderScalar("##depth", ImGuiDataType_U32, &overlay.options.depth, &minDepth,
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
