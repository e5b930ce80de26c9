// SPDX-License-Identifier: MIT
#include "editor_ui/panels/export_dialog.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/setting_row.h"
#include "editor_ui/panels/theme.h"
#include "engine/export/export_table.h"
#include "engine/scene/export_settings_fields.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace limn {

namespace fs = std::filesystem;

/// Beside the project; in the working directory where there is none yet.
static std::string defaultPath(const EditorState& state, const ExportFormat& format) {
    const fs::path document =
        state.projectPath.empty() ? state.document.scenePath : state.projectPath;
    const std::string stem = document.empty() ? "untitled" : document.stem().string();
    const std::string name =
        fmt::format("{}-{}{}", stem, format.name,
                    format.extensions.empty() ? std::string_view() : format.extensions.front());
    std::error_code error;
    const fs::path folder =
        state.projectPath.empty() ? fs::current_path(error) : document.parent_path();
    return (folder / name).string();
}

/// The dialog's format; the first one where the document names one that is unknown.
static const ExportFormat& formatOf(const ExportDialog& dialog) {
    const ExportFormat* format = findExportFormat(dialog.settings.format);
    return format ? *format : *exportFormats().front();
}

static void chooseFormat(const EditorState& state, ExportDialog& dialog,
                         const ExportFormat& format) {
    dialog.settings.format = format.name;
    dialog.overwrite = false;
    dialog.problem.clear();
    if (!dialog.ownPath)
        dialog.path = defaultPath(state, format);
    else if (!format.extensions.empty())
        dialog.path = fs::path(dialog.path).replace_extension(format.extensions.front()).string();
}

void openExportDialog(EditorState& state) {
    ExportDialog dialog;
    dialog.settings = singleton<ExportSettings>(state.document);
    chooseFormat(state, dialog, formatOf(dialog));
    state.exporting.written.clear();
    state.exporting.error.clear();
    state.exportDialog = std::move(dialog);
}

void setExportPath(ExportDialog& dialog, std::string path) {
    dialog.path = std::move(path);
    dialog.ownPath = true;
    dialog.overwrite = false;
    dialog.problem.clear();
}

static void formatRow(const EditorState& state, ExportDialog& dialog) {
    const ExportFormat& current = formatOf(dialog);
    fieldLabel("Format", "What is written, and for whom");
    if (!ImGui::BeginCombo("##format", current.label))
        return;
    for (const ExportFormat* format : exportFormats()) {
        if (ImGui::Selectable(format->label, format == &current))
            chooseFormat(state, dialog, *format);
        wrappedTooltip(format->summary);
    }
    ImGui::EndCombo();
}

static void pathRow(EditorState& state, ExportDialog& dialog) {
    const bool folder = formatOf(dialog).extensions.empty();
    fieldLabel(folder ? "Folder" : "File",
               folder ? "The folder is created; files in it are replaced"
                      : "The main file. The others lie beside it and begin with its name");
    const float button = ImGui::CalcTextSize("Browse\u2026").x + ImGui::GetFontSize();
    ImGui::SetNextItemWidth(-button - ImGui::GetStyle().ItemSpacing.x);
    std::string path = dialog.path;
    if (ImGui::InputText("##path", &path))
        setExportPath(dialog, path);
    if (ImGui::IsItemHovered())
        wrappedTooltip(dialog.path.c_str());
    ImGui::SameLine();
    if (ImGui::Button("Browse\u2026", {button, 0}))
        openFileBrowser(state, FileBrowser::Purpose::ExportTo);
}

/// The rows of the settings that the format reads.
static void settingRows(ExportDialog& dialog) {
    const ExportFormat& format = formatOf(dialog);
    visitExportSettings(
        dialog.settings, [&](const Setting& setting, auto& value, const auto&... limits) {
            if (!setting.applies ||
                std::ranges::find(format.settings, setting.key) == format.settings.end())
                return;
            fieldLabel(setting.label, setting.tooltip);
            settingWidget(setting, value, limits...);
        });
    dialog.settings.detail |= 1; // only odd numbers keep charts apart
}

static void forecastLine(const ExportForecast& f) {
    if (f.bytes == 0)
        return;
    std::string text = "About " + byteText(f.bytes);
    if (f.width > 0)
        text += fmt::format(", lightmap of {}{} \u00d7 {} texels",
                            f.pages > 1 ? fmt::format("{} textures of ", f.pages) : "", f.width,
                            f.height);
    ImGui::TextDisabled("%s", text.c_str());
}

/// Why the export cannot start with that path; empty: it can.
static std::string pathProblem(const EditorState& state, ExportDialog& dialog) {
    if (dialog.path.empty())
        return "Type where to write";
    if (const Result<void> possible = checkExportPath(dialog.path, formatOf(dialog)); !possible)
        return possible.error().message;
    std::error_code error;
    if (fs::equivalent(dialog.path, state.document.scenePath, error))
        return "This is the scene's own file; choose another name";
    if (fs::exists(dialog.path, error) && !dialog.overwrite) {
        dialog.overwrite = true;
        return "It exists. Press Export again to replace it";
    }
    return {};
}

/// Makes the dialog's settings the document's, and asks for the export.
static void startExport(EditorState& state, ExportDialog& dialog) {
    dialog.problem = pathProblem(state, dialog);
    if (!dialog.problem.empty())
        return;
    setExportSettings(state, dialog.settings);
    state.requests.push_back({Request::Kind::Export, dialog.path});
}

static void outcomeLines(const ExportStatus& status, const ExportDialog& dialog) {
    ImGui::PushTextWrapPos(0);
    if (!dialog.problem.empty())
        ImGui::TextColored(ImColor(color::warning()), "%s", dialog.problem.c_str());
    else if (!status.refusal.empty())
        ImGui::TextColored(ImColor(color::warning()), "%s", status.refusal.c_str());
    else if (!status.error.empty())
        ImGui::TextColored(ImColor(color::warning()), "%s", status.error.c_str());
    else if (!status.written.empty())
        ImGui::TextUnformatted(status.written.c_str());
    else
        ImGui::TextUnformatted(" ");
    ImGui::PopTextWrapPos();
}

/// Returns false when the dialog is to be closed.
static bool buttons(EditorState& state, ExportDialog& dialog) {
    const ExportStatus& status = state.exporting;
    if (status.running) {
        const std::string text = fmt::format("{} {:.0f} %", status.stage, 100 * status.fraction);
        ImGui::ProgressBar(status.fraction, {ImGui::GetContentRegionAvail().x * 0.7f, 0},
                           text.c_str());
        ImGui::SameLine();
        if (ImGui::Button("Cancel"))
            state.requests.push_back({Request::Kind::CancelExport, {}});
        wrappedTooltip("Stops the export; files that were there before stay");
        return true;
    }
    ImGui::BeginDisabled(!status.refusal.empty());
    if (ImGui::Button("Export"))
        startExport(state, dialog);
    ImGui::EndDisabled();
    ImGui::SameLine();
    return !ImGui::Button("Close") && !ImGui::IsKeyPressed(key::kEscape);
}

void exportDialog(EditorState& state) {
    constexpr const char* kTitle = "Export light";
    if (!state.exportDialog || state.fileBrowser)
        return;
    ExportDialog& dialog = *state.exportDialog;
    if (!ImGui::IsPopupOpen(kTitle))
        ImGui::OpenPopup(kTitle);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(ImGui::GetFontSize() * 34, display.x * 0.9f), 0});
    if (!ImGui::BeginPopupModal(kTitle, nullptr,
                                ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize))
        return;
    ImGui::BeginDisabled(state.exporting.running);
    formatRow(state, dialog);
    ImGui::PushTextWrapPos(0);
    ImGui::TextDisabled("%s.", formatOf(dialog).summary);
    ImGui::PopTextWrapPos();
    settingRows(dialog);
    pathRow(state, dialog);
    ImGui::EndDisabled();
    forecastLine(state.exporting.forecast);
    outcomeLines(state.exporting, dialog);
    const bool stays = buttons(state, dialog);
    if (!stays || state.fileBrowser)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (!stays)
        state.exportDialog.reset();
}

} // namespace limn
