// SPDX-License-Identifier: MIT
#include "editor_ui/panels/field.h"

#include "editor_ui/document/common_edit.h"
#include "editor_ui/document/object_rules.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/theme.h"
#include "engine/scene/origin.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

namespace limn {

FieldEdit::FieldEdit(EditorState& editor, ObjectId object)
    : state(editor), id(object), seen(editor.document.objects.at(object)) {}

const ObjectsById& FieldEdit::objects() const {
    return state.document.objects;
}

void wrappedTooltip(const char* text) {
    if (!text || !*text || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void fieldLabel(const char* label, const char* tooltip) {
    // A mark may stand before the label; the widgets stay in their column.
    const float left = ImGui::GetCursorPosX(), start = ImGui::GetCursorStartPos().x;
    const float column = start + std::max((ImGui::GetContentRegionAvail().x + left - start) * 0.42f,
                                          ImGui::GetFontSize() * 4);
    ImGui::AlignTextToFramePadding();
    elidedText(label, std::max(column - left - ImGui::GetStyle().ItemSpacing.x, 1.f));
    wrappedTooltip(tooltip);
    ImGui::SameLine(column);
    ImGui::SetNextItemWidth(-FLT_MIN);
}

void markMixed() {
    // A sign of "not equal", drawn because fonts may lack it.
    const float h = ImGui::GetFontSize(), w = h * 0.5f;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::Dummy({w, ImGui::GetFrameHeight()});
    wrappedTooltip("The selected objects have different values here; the one shown is that of the "
                   "object selected last");
    const float middle = corner.y + ImGui::GetFrameHeight() / 2;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 ink = color::warning();
    const float line = std::max(h / 12, 1.f);
    for (const float side : {-0.12f, 0.12f})
        list.AddLine({corner.x, middle + side * h}, {corner.x + w, middle + side * h}, ink, line);
    list.AddLine({corner.x + w * 0.2f, middle + 0.3f * h}, {corner.x + w * 0.8f, middle - 0.3f * h},
                 ink, line);
    ImGui::SameLine(0, h * 0.25f);
}

static constexpr const char* kMillimetres = "%.3f";

/// Whether three fields beside each other show all digits.
static bool fitBeside(const glm::dvec3& position) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float each = (ImGui::CalcItemWidth() - 2 * style.ItemInnerSpacing.x) / 3;
    for (int c = 0; c < 3; ++c) {
        char digits[400]; // as many as a double can have before its point
        std::snprintf(digits, sizeof digits, kMillimetres, position[c]);
        if (ImGui::CalcTextSize(digits).x > each - 2 * style.FramePadding.x)
            return false;
    }
    return true;
}

/// Three numbers in a row, or in three rows where they are long.
static bool dragPosition(const char* id, glm::dvec3& position) {
    constexpr float kSpeed = 0.01f;
    if (fitBeside(position))
        return ImGui::DragScalarN(id, ImGuiDataType_Double, &position.x, 3, kSpeed, nullptr,
                                  nullptr, kMillimetres);
    const float width = ImGui::CalcItemWidth();
    bool changed = false;
    ImGui::PushID(id);
    ImGui::BeginGroup();
    for (int c = 0; c < 3; ++c) {
        ImGui::PushID(c);
        ImGui::SetNextItemWidth(width);
        changed |= ImGui::DragScalar("##axis", ImGuiDataType_Double, &position[c], kSpeed, nullptr,
                                     nullptr, kMillimetres);
        ImGui::PopID();
    }
    ImGui::EndGroup();
    ImGui::PopID();
    return changed;
}

void positionField(const char* id, glm::vec3& position, const glm::dvec3& origin) {
    glm::dvec3 shown = toFile(origin, position);
    if (dragPosition(id, shown))
        position = toWorld(origin, shown);
}

void positionField(const char* id, glm::dvec3& translation) {
    dragPosition(id, translation);
}

/// Gives the other objects what has changed in `now`, where they stay valid.
static void editTogether(FieldEdit& edit, const Object& now, const char* label) {
    ObjectsById seen{{edit.id, edit.seen}};
    for (ObjectId id : edit.others) {
        Object& other = edit.state.document.objects.at(id);
        Object after = other;
        copyChanges(edit.seen, now, after);
        seen.emplace(id, other);
        if (isValid(after))
            other = std::move(after);
    }
    trackEdits(edit.state, seen, label);
    edit.seen = now;
}

void fieldEdited(FieldEdit& edit, const char* label) {
    Object& now = edit.state.document.objects.at(edit.id);
    if (!isValid(now))
        now = edit.seen;
    if (edit.others.empty() || now == edit.seen)
        trackEdit(edit.state, edit.id, edit.seen, label);
    else
        editTogether(edit, now, label);
}

/// Longest prefix of whole UTF-8 characters that fits.
static std::size_t fittingPrefix(const std::string& text, float width) {
    const char* end = text.data() + text.size();
    const char* cut = nullptr;
    ImGui::GetFont()->CalcTextSizeA(ImGui::GetFontSize(), width, 0, text.data(), end, &cut);
    return cut ? std::size_t(cut - text.data()) : text.size();
}

std::string elided(const std::string& text, float width) {
    if (ImGui::CalcTextSize(text.c_str()).x <= width)
        return text;
    const float dots = ImGui::CalcTextSize("...").x;
    return text.substr(0, fittingPrefix(text, std::max(width - dots, 1.f))) + "...";
}

void elidedText(const std::string& text, float width) {
    const std::string shown = elided(text, width);
    ImGui::TextUnformatted(shown.data(), shown.data() + shown.size());
    if (shown.size() != text.size())
        wrappedTooltip(text.c_str());
}

std::string groupedNumber(unsigned long long n) {
    std::string digits = std::to_string(n), out;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0)
            out += ' ';
        out += digits[i];
    }
    return out;
}

std::string byteText(unsigned long long bytes) {
    const char* const units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
    double value = double(bytes);
    std::size_t unit = 0;
    while (value >= 1024 && unit + 1 < std::size(units))
        value /= 1024, ++unit;
    return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.1f} {}", value, units[unit]);
}

std::string durationText(double seconds) {
    if (seconds <= 0)
        return "0 s";
    if (seconds < 1)
        return fmt::format("{:.{}f} ms", seconds * 1e3, seconds < 0.01 ? 2 : 0);
    if (seconds < 60)
        return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<unsigned long long>(std::lround(seconds));
    return fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

} // namespace limn
