// SPDX-License-Identifier: MIT
#include "editor_ui/panels/start_screen.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/field.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>

namespace limn {

namespace {

constexpr std::size_t kRecent = 8; ///< rows

void openRow(EditorState& state, const std::string& label, const std::string& path,
             const char* tooltip) {
    ImGui::PushID(path.c_str());
    const std::string shown = elided(label, ImGui::GetContentRegionAvail().x);
    if (ImGui::Selectable((shown + "###open").c_str()))
        state.requests.push_back({Request::Kind::Open, path});
    wrappedTooltip(tooltip);
    ImGui::PopID();
}

void recentRows(EditorState& state) {
    ImGui::TextDisabled("Recent");
    if (state.recent.empty())
        ImGui::TextDisabled("Nothing yet");
    for (std::size_t i = 0; i < std::min(state.recent.size(), kRecent); ++i) {
        const std::string path = state.recent[i];
        openRow(state, std::filesystem::path(path).filename().string(), path, path.c_str());
    }
}

void sampleRows(EditorState& state) {
    if (state.samples.empty())
        return;
    ImGui::TextDisabled("Samples");
    for (const std::string& sample : state.samples)
        openRow(state, sample, sample, "A scene that comes with the program");
}

} // namespace

void startScreen(EditorState& state) {
    const bool open = std::ranges::any_of(state.document.objects, [](const auto& entry) {
        return std::holds_alternative<Node>(entry.second);
    });
    if (open || !state.loading.empty())
        return;
    const ViewState& view = state.view;
    const float font = ImGui::GetFontSize();
    const float width = std::min(view.size.x - font, font * 32);
    const float height = view.size.y - font;
    if (width < font * 8 || height < font * 8)
        return;
    const ImVec2 middle(view.origin.x + view.size.x / 2, view.origin.y + view.size.y / 2);
    ImGui::SetNextWindowPos(middle, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, height});
    ImGui::Begin("start", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted("Drop a .gltf, .glb or .limn here, or open one");
    ImGui::PopTextWrapPos();
    for (const char* id : {"file.open", "file.new", "help.keys"}) {
        const Action& action = actionById(id);
        const float button = ImGui::CalcTextSize(action.label).x + 2 * font;
        if (ImGui::GetContentRegionAvail().x < button)
            ImGui::NewLine();
        if (ImGui::Button(action.label))
            runAction(state, action);
        wrappedTooltip(shortcutText(shortcutOf(state, action)).c_str());
        ImGui::SameLine();
    }
    ImGui::NewLine();
    ImGui::Spacing();
    if (ImGui::BeginTable("lists", 2)) {
        ImGui::TableSetupColumn("recent", ImGuiTableColumnFlags_WidthStretch, 0.62f);
        ImGui::TableSetupColumn("samples", ImGuiTableColumnFlags_WidthStretch, 0.38f);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        recentRows(state);
        ImGui::TableNextColumn();
        sampleRows(state);
        ImGui::EndTable();
    }
    ImGui::End();
}

} // namespace limn
