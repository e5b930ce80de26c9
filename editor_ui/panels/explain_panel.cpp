// SPDX-License-Identifier: MIT
#include "editor_ui/panels/explain_panel.h"

#include "editor_ui/document/muted.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/icon.h"
#include "editor_ui/panels/theme.h"
#include "editor_ui/view/picking.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>

namespace limn {

void explainAt(EditorState& state, glm::vec2 mouse) {
    const Hit hit = hitUnder(state, mouse);
    if (!hit)
        return;
    const Picture picture = state.view.picture();
    const glm::uvec2 size(picture.size);
    const glm::uvec2 pixel(glm::clamp(mouse - picture.origin, glm::vec2(0), picture.size - 1.f));
    state.explain.pick = {
        .question = {.camera = picture.camera,
                     .width = size.x,
                     .height = size.y,
                     .x = std::min(pixel.x, size.x - 1),
                     .y = std::min(pixel.y, size.y - 1),
                     .samples = kScreenSamples.perPixel,
                     .nearRays = state.frame.nearLight ? kScreenSamples.nearRays : 0,
                     .gatherRays = state.frame.gathers ? kScreenSamples.gatherRays : 0},
        .point = hit.position};
}

namespace {

/// The object that a row names, or, where it names none, the nearest row above it.
ObjectId objectOf(const ExplainedPixel& pixel, const std::vector<LightRow>& rows,
                  const LightRow& row) {
    if (row.kind == LightRowKind::Light && row.index < pixel.lights.size())
        return pixel.lights[row.index];
    if (row.kind == LightRowKind::Surface && row.index < pixel.nodes.size())
        return pixel.nodes[row.index];
    return row.parent == LightRow::kNone ? 0 : objectOf(pixel, rows, rows[row.parent]);
}

/// The hue of light at full brightness, in sRGB.
ImU32 hueOf(glm::vec3 light) {
    const glm::vec3 positive = glm::max(light, glm::vec3(0));
    const float maximum = std::max({positive.x, positive.y, positive.z});
    const glm::vec3 c =
        maximum > 0 ? glm::pow(positive / maximum, glm::vec3(1 / 2.2f)) : glm::vec3(0);
    return ImGui::ColorConvertFloat4ToU32({c.x, c.y, c.z, 1});
}

void swatch(glm::vec3 light) {
    const float side = ImGui::GetTextLineHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 from(corner.x, corner.y + 2), to(corner.x + side, corner.y + side - 1);
    list.AddRectFilled(from, to, hueOf(light), 2);
    list.AddRect(from, to, color::dim(), 2);
    ImGui::Dummy({side, side});
    ImGui::SameLine();
}

std::string rgbText(glm::vec3 light) {
    return fmt::format("{:.3g}  {:.3g}  {:.3g}", light.x, light.y, light.z);
}

void shareBar(double share) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
    const float filled = width * float(std::clamp(share, 0., 1.));
    ImGui::GetWindowDrawList()->AddRectFilled({corner.x, corner.y + 1},
                                              {corner.x + filled, corner.y + height},
                                              (color::accent() & 0x00ffffffU) | 0x70000000U, 2);
    ImGui::Text("%5.1f %%", 100 * share);
}

/// The object that can be muted by this row; 0: none.
ObjectId mutedBy(const EditorState& state, const ExplainedPixel& pixel,
                 const std::vector<LightRow>& rows, const LightRow& row) {
    ObjectId id = 0;
    if (row.kind == LightRowKind::Sky) {
        for (const auto& [key, object] : state.document.objects)
            if (std::holds_alternative<Sky>(object))
                id = key;
    } else if (row.kind == LightRowKind::Light || row.kind == LightRowKind::Surface) {
        id = objectOf(pixel, rows, row);
    }
    const auto it = state.document.objects.find(id);
    return it != state.document.objects.end() && canMute(it->second) ? id : 0;
}

/// An eye that shows the picture without the object, or with it again.
void muteButton(ExplainState& explain, ObjectId id, bool emits) {
    const bool muted = explain.muted.contains(id);
    const float side = ImGui::GetTextLineHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton("mute", {side * 1.5f, side})) {
        if (muted)
            explain.muted.erase(id);
        else
            explain.muted.insert(id);
    }
    const bool hovered = ImGui::IsItemHovered();
    drawIcon(*ImGui::GetWindowDrawList(), muted ? Icon::Hidden : Icon::Shown,
             {corner.x + side * 0.75f, corner.y + side / 2}, side,
             muted     ? color::warning()
             : hovered ? ImGui::GetColorU32(ImGuiCol_Text)
                       : color::dim());
    wrappedTooltip(emits ? "Shows the picture without this light. The table keeps it, and nothing "
                           "is saved"
                         : "Shows the picture as if this object reflected no light. The table "
                           "keeps it, and nothing is saved");
}

struct Table {
    EditorState& state;
    const ExplainedPixel& pixel;
    const std::vector<LightRow>& rows;
    std::vector<std::vector<std::uint32_t>> below; ///< indices of the rows below each row

    void row(std::uint32_t k) {
        const LightRow& r = rows[k];
        const ObjectId object = objectOf(pixel, rows, r);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::PushID(int(k));
        ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_SpanFullWidth |
                                   ImGuiTreeNodeFlags_OpenOnArrow |
                                   ImGuiTreeNodeFlags_OpenOnDoubleClick;
        if (below[k].empty())
            flags |= ImGuiTreeNodeFlags_Leaf;
        if (r.parent == LightRow::kNone)
            flags |= ImGuiTreeNodeFlags_DefaultOpen;
        const float label = ImGui::GetCursorPosX() + ImGui::GetTreeNodeToLabelSpacing();
        const bool open = ImGui::TreeNodeEx("##row", flags);
        if (ImGui::IsItemHovered() && object != 0)
            state.explain.hovered = object;
        if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen() &&
            state.document.objects.contains(object))
            state.selection = {object};
        ImGui::SameLine();
        ImGui::SetCursorPosX(label);
        elidedText(r.label, ImGui::GetContentRegionAvail().x);
        ImGui::TableNextColumn();
        shareBar(shareOf(r.value, pixel.explanation.total));
        ImGui::TableNextColumn();
        swatch(r.value);
        elidedText(rgbText(r.value), ImGui::GetContentRegionAvail().x);
        ImGui::TableNextColumn();
        if (const ObjectId id = mutedBy(state, pixel, rows, r))
            muteButton(state.explain, id, r.kind != LightRowKind::Surface);
        if (open) {
            for (const std::uint32_t child : below[k])
                row(child);
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
};

/// A heading that says what the column shows.
void heading(int column, const char* tooltip) {
    ImGui::TableSetColumnIndex(column);
    ImGui::TableHeader(ImGui::TableGetColumnName(column));
    wrappedTooltip(tooltip);
}

void table(EditorState& state, const ExplainedPixel& pixel) {
    const Explanation& tables = pixel.explanation.tables;
    const std::vector<LightRow>& rows = state.explain.bySender ? tables.bySender : tables.byOrigin;
    constexpr ImGuiTableFlags kFlags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerV;
    if (!ImGui::BeginTable(state.explain.bySender ? "sender" : "origin", 4, kFlags))
        return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("Where from", ImGuiTableColumnFlags_WidthStretch, 0.5f);
    ImGui::TableSetupColumn("Share", ImGuiTableColumnFlags_WidthStretch, 0.2f);
    ImGui::TableSetupColumn("Red, green, blue", ImGuiTableColumnFlags_WidthStretch, 0.3f);
    ImGui::TableSetupColumn("Shown", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFontSize() * 4);
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    heading(0, "Lights, objects and the sky. A click selects the object");
    heading(1, "Of the luminance of all light of the pixel [%]");
    heading(2, pixel.light == PixelLight::Radiance
                   ? "Radiance that reaches the eye by this row [W m^-2 sr^-1]"
                   : "Irradiance that arrives by this row [W m^-2]");
    heading(3, "The eye shows the picture without the row's light or object");
    Table all{state, pixel, rows, std::vector<std::vector<std::uint32_t>>(rows.size())};
    for (std::uint32_t k = 0; k < rows.size(); ++k)
        if (rows[k].parent != LightRow::kNone)
            all.below[rows[k].parent].push_back(k);
    for (std::uint32_t k = 0; k < rows.size(); ++k)
        if (rows[k].parent == LightRow::kNone)
            all.row(k);
    ImGui::EndTable();
}

template <class Value>
void choice(const char* label, Value& value, Value choice, const char* tooltip) {
    if (ImGui::RadioButton(label, value == choice))
        value = choice;
    wrappedTooltip(tooltip);
    ImGui::SameLine();
}

void choices(ExplainState& explain) {
    choice("By origin", explain.bySender, false,
           "Which lights, sky and emissive surfaces the light comes from, over all bounces");
    choice("By sender", explain.bySender, true,
           "What sends the light to this place, however it got there: lights, sky, objects, and "
           "of these clusters and surfels");
    ImGui::SameLine(0, ImGui::GetFontSize() * 1.5f);
    choice("Radiance", explain.light, PixelLight::Radiance,
           "The light that reaches the eye [W m^-2 sr^-1]");
    choice("Irradiance", explain.light, PixelLight::Irradiance,
           "The light that arrives at the surface [W m^-2]");
    ImGui::SameLine(0, ImGui::GetFontSize() * 1.5f);
}

} // namespace

void explainPanel(EditorState& state) {
    ExplainState& explain = state.explain;
    choices(explain);
    if (!explain.muted.empty()) {
        if (ImGui::SmallButton(fmt::format("Show all ({} muted)", explain.muted.size()).c_str()))
            explain.muted.clear();
        ImGui::SameLine();
    }
    if (explain.pick)
        explain.pick->question.light = explain.light;
    const float width = ImGui::GetContentRegionAvail().x;
    if (!explain.refusal.empty() || !explain.error.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, color::warning());
        elidedText(explain.refusal.empty() ? explain.error : explain.refusal, width);
        ImGui::PopStyleColor();
    } else if (!explain.pick) {
        elidedText("Click a surface in the picture to see where its light comes from", width);
    } else if (const ExplainedPixel* pixel = explain.result.get()) {
        const glm::vec3 total = pixel->explanation.total;
        elidedText(fmt::format("{}  {}, {} bounces followed{}", rgbText(total),
                               unitOf(pixel->light), pixel->explanation.tables.bounces,
                               explain.running ? ", updating" : ""),
                   width);
    } else {
        elidedText("Working", width);
    }
    if (explain.result && explain.pick)
        table(state, *explain.result);
}

} // namespace limn
