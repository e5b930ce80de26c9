// SPDX-License-Identifier: MIT
#include "editor_ui/panels/lint_panel.h"

#include "editor_ui/panels/field.h"
#include "editor_ui/panels/theme.h"
#include "engine/lint/lint.h"

#include <imgui.h>

#include <algorithm>

#include <fmt/format.h>

namespace limn {

namespace {

std::string countText(std::span<const Finding> findings) {
    const auto counts = countBySeverity(findings);
    const auto part = [](std::size_t count, const char* what) {
        return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
    };
    return part(counts[2], "error") + ", " + part(counts[1], "warning") + ", " +
           part(counts[0], "note");
}

void checkRow(EditorState& state) {
    LintState& lint = state.lint;
    if (lint.running) {
        if (ImGui::Button("Cancel###check"))
            state.requests.push_back({Request::Kind::CancelLint});
        wrappedTooltip("Stops the check");
        ImGui::SameLine();
        ImGui::ProgressBar(lint.fraction, {12 * ImGui::GetFontSize(), 0},
                           lint.stage.empty() ? "reading" : lint.stage.c_str());
        return;
    }
    if (ImGui::Button("Check the scene###check"))
        state.requests.push_back({Request::Kind::Lint});
    wrappedTooltip("Looks for what makes baked or live light go wrong: coordinates, thin walls, "
                   "backs, albedos, units of lights, sizes");
    ImGui::SameLine();
    if (!lint.error.empty())
        ImGui::TextColored(ImColor(color::warning()), "Not checked: %s", lint.error.c_str());
    else if (!lint.findings)
        ImGui::TextDisabled("Not checked yet");
    else
        ImGui::TextDisabled("%s%s", countText(*lint.findings).c_str(),
                            lint.outdated ? ", before the latest changes" : "");
}

void severityCell(Severity severity) {
    const char* name = severityName(severity).data();
    switch (severity) {
    case Severity::Note:
        ImGui::TextDisabled("%s", name);
        break;
    case Severity::Warning:
        ImGui::TextColored(ImColor(color::warning()), "%s", name);
        break;
    case Severity::Error:
        ImGui::TextColored(ImColor(color::error()), "%s", name);
        break;
    }
}

/// The row's text, of which a click selects the object.
void objectCell(EditorState& state, const Finding& finding) {
    const bool exists = findObject(state, finding.object) != nullptr;
    const bool selected =
        exists && std::ranges::find(state.selection, finding.object) != state.selection.end();
    const std::string path = finding.path.empty() ? "The scene" : finding.path;
    const std::string shown = elided(path, ImGui::GetContentRegionAvail().x);
    constexpr ImGuiSelectableFlags kFlags = ImGuiSelectableFlags_SpanAllColumns;
    ImGui::BeginDisabled(!exists);
    if (ImGui::Selectable((shown + "###object").c_str(), selected, kFlags))
        state.selection = {finding.object};
    ImGui::EndDisabled();
    const std::string tip =
        fmt::format("{}\n\n{}\n\n{}\n\n{}", path, finding.problem, finding.advice,
                    exists ? "Click: selects it; F then shows it" : "");
    wrappedTooltip(tip.c_str());
}

void findingRow(EditorState& state, const Finding& finding, int row) {
    ImGui::PushID(row);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    severityCell(finding.severity);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(finding.rule->name.data(),
                           finding.rule->name.data() + finding.rule->name.size());
    ImGui::TableNextColumn();
    objectCell(state, finding);
    ImGui::TableNextColumn();
    const std::string problem = elided(finding.problem, ImGui::GetContentRegionAvail().x);
    ImGui::TextUnformatted(problem.c_str());
    ImGui::PopID();
}

void headings() {
    const float font = ImGui::GetFontSize();
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("Severity", ImGuiTableColumnFlags_WidthFixed, 5 * font);
    ImGui::TableSetupColumn("Rule", ImGuiTableColumnFlags_WidthFixed, 11 * font);
    ImGui::TableSetupColumn("Object", ImGuiTableColumnFlags_WidthStretch, 0.3f);
    ImGui::TableSetupColumn("What is wrong", ImGuiTableColumnFlags_WidthStretch, 0.7f);
    ImGui::TableHeadersRow();
}

} // namespace

void lintPanel(EditorState& state) {
    checkRow(state);
    // The rows may be replaced while they are drawn.
    const auto findings = state.lint.findings;
    if (!findings)
        return;
    if (findings->empty()) {
        ImGui::TextDisabled("Nothing is wrong with the scene");
        return;
    }
    constexpr ImGuiTableFlags kFlags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerV;
    if (!ImGui::BeginTable("findings", 4, kFlags))
        return;
    headings();
    ImGuiListClipper clipper;
    clipper.Begin(int(findings->size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
            findingRow(state, (*findings)[std::size_t(i)], i);
    ImGui::EndTable();
}

} // namespace limn
