// SPDX-License-Identifier: MIT
#include "editor_ui/panels/file_browser.h"

#include "editor_ui/document/picture_files.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/theme.h"
#include "engine/core/user_folder.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace limn {

namespace fs = std::filesystem;

static bool fits(FileBrowser::Purpose purpose, std::string extension) {
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return char(std::tolower(c)); });
    const bool scene = extension == ".gltf" || extension == ".glb";
    switch (purpose) {
    case FileBrowser::Purpose::NewFromScene:
    case FileBrowser::Purpose::AddScene:
        return scene;
    case FileBrowser::Purpose::Texture:
        return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
    case FileBrowser::Purpose::Open:
        return scene || extension == ".limn";
    case FileBrowser::Purpose::SaveAs:
        return extension == ".limn";
    case FileBrowser::Purpose::SkyImage:
        return extension == ".hdr" || extension == ".exr";
    case FileBrowser::Purpose::LightProfile:
        return extension == ".ies";
    case FileBrowser::Purpose::SavePictures:
        return extension == ".exr";
    case FileBrowser::Purpose::ExportTo:
        return true;
    }
    return false;
}

void readFolder(FileBrowser& browser, const std::string& folder) {
    std::error_code error;
    fs::path path = fs::weakly_canonical(folder, error);
    if (error)
        path = folder;
    fs::directory_iterator it(path, fs::directory_options::skip_permission_denied, error);
    if (error) {
        browser.error = "Cannot read " + path.string() + ": " + error.message();
        return;
    }
    browser.folder = path.string();
    browser.entries.clear();
    browser.error.clear();
    for (; it != fs::directory_iterator(); it.increment(error)) {
        if (error)
            break;
        const std::string name = it->path().filename().string();
        const bool isFolder = it->is_directory(error);
        if (name.starts_with('.') ||
            (!isFolder && !fits(browser.purpose, it->path().extension().string())))
            continue;
        browser.entries.push_back({name, isFolder});
    }
    std::ranges::sort(browser.entries, [](const auto& a, const auto& b) {
        return a.isFolder != b.isFolder ? a.isFolder : a.name < b.name;
    });
}

void openFileBrowser(EditorState& state, FileBrowser::Purpose purpose) {
    FileBrowser browser;
    browser.purpose = purpose;
    const std::string image = singleton<Sky>(state.document).image;
    const bool exporting = purpose == FileBrowser::Purpose::ExportTo && state.exportDialog;
    const fs::path current = purpose == FileBrowser::Purpose::SkyImage && !image.empty() ? image
                             : exporting                 ? state.exportDialog->path
                             : state.projectPath.empty() ? state.document.scenePath
                                                         : state.projectPath;
    if (exporting)
        browser.name = current.filename().string();
    if (purpose == FileBrowser::Purpose::SaveAs)
        browser.name = current.empty() ? "untitled.limn" : current.stem().string() + ".limn";
    if (purpose == FileBrowser::Purpose::SavePictures)
        browser.name = current.empty() ? "untitled.exr" : current.stem().string() + ".exr";
    std::error_code error;
    fs::path folder = current.parent_path();
    const bool saves =
        purpose == FileBrowser::Purpose::SaveAs || purpose == FileBrowser::Purpose::SavePictures;
    if (saves && state.projectPath.empty() && state.sample)
        folder = documentsFolder(); // what came with the program is not the user's to replace
    readFolder(browser, (folder.empty() ? fs::current_path(error) : folder).string());
    state.fileBrowser = std::move(browser);
}

void openTextureBrowser(EditorState& state, ObjectId material, TextureSlot slot) {
    openFileBrowser(state, FileBrowser::Purpose::Texture);
    state.fileBrowser->object = material;
    state.fileBrowser->slot = slot;
}

void openProfileBrowser(EditorState& state, ObjectId light) {
    openFileBrowser(state, FileBrowser::Purpose::LightProfile);
    state.fileBrowser->object = light;
}

static const char* title(FileBrowser::Purpose purpose) {
    switch (purpose) {
    case FileBrowser::Purpose::NewFromScene:
        return "New from scene";
    case FileBrowser::Purpose::Open:
        return "Open";
    case FileBrowser::Purpose::SaveAs:
        return "Save as";
    case FileBrowser::Purpose::SkyImage:
        return "Sky image";
    case FileBrowser::Purpose::LightProfile:
        return "IES profile";
    case FileBrowser::Purpose::ExportTo:
        return "Export to";
    case FileBrowser::Purpose::AddScene:
        return "Add the objects of a file";
    case FileBrowser::Purpose::Texture:
        return "Texture";
    case FileBrowser::Purpose::SavePictures:
        return "Save NAME-limn.exr and NAME-reference.exr";
    }
    return "";
}

static const char* acceptLabel(FileBrowser::Purpose purpose) {
    switch (purpose) {
    case FileBrowser::Purpose::NewFromScene:
    case FileBrowser::Purpose::Open:
    case FileBrowser::Purpose::SkyImage:
    case FileBrowser::Purpose::LightProfile:
        return "Open";
    case FileBrowser::Purpose::SaveAs:
    case FileBrowser::Purpose::SavePictures:
        return "Save";
    case FileBrowser::Purpose::ExportTo:
    case FileBrowser::Purpose::Texture:
        return "Choose";
    case FileBrowser::Purpose::AddScene:
        return "Add";
    }
    return "";
}

static void pathRow(FileBrowser& browser) {
    if (ImGui::Button("Up"))
        readFolder(browser, fs::path(browser.folder).parent_path().string());
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    elidedText(browser.folder, ImGui::GetContentRegionAvail().x);
}

/// True when a file was double-clicked.
static bool entryList(FileBrowser& browser) {
    bool chosen = false;
    std::string enter;
    const float footer =
        2 * ImGui::GetFrameHeightWithSpacing() + ImGui::GetTextLineHeightWithSpacing();
    if (ImGui::BeginChild("entries", {0, -footer}, true)) {
        for (const FileBrowser::Entry& entry : browser.entries) {
            ImGui::PushID(entry.name.c_str());
            const ImVec2 start = ImGui::GetCursorPos();
            if (ImGui::Selectable("##entry", !entry.isFolder && entry.name == browser.name,
                                  ImGuiSelectableFlags_AllowDoubleClick)) {
                if (!entry.isFolder)
                    browser.name = entry.name;
                else if (ImGui::IsMouseDoubleClicked(0))
                    enter = entry.name;
                browser.overwrite = false;
                chosen = !entry.isFolder && ImGui::IsMouseDoubleClicked(0);
            }
            ImGui::SetCursorPos(start);
            elidedText(entry.isFolder ? entry.name + "/" : entry.name,
                       ImGui::GetContentRegionAvail().x);
            ImGui::PopID();
        }
        if (browser.entries.empty())
            ImGui::TextDisabled("No folder and no file that fits");
    }
    ImGui::EndChild();
    if (!enter.empty())
        readFolder(browser, (fs::path(browser.folder) / enter).string());
    return chosen;
}

/// The request to write two pictures; the first time that one of them exists, a warning instead.
static std::optional<Request> picturesRequest(FileBrowser& browser, const fs::path& path) {
    std::error_code error;
    for (const std::string& file : pictureFiles(path))
        if (fs::exists(file, error) && !browser.overwrite) {
            browser.overwrite = true;
            browser.error = file + " exists. Press Save again to replace it";
            return {};
        }
    return Request{Request::Kind::SavePictures, fs::path(path).replace_extension(".exr").string()};
}

/// The request for the chosen file; sets browser.error when there is none yet.
static std::optional<Request> accepted(FileBrowser& browser) {
    if (browser.name.empty()) {
        browser.error = "Choose a file or type its name";
        return {};
    }
    fs::path path = fs::path(browser.folder) / browser.name;
    std::error_code error;
    if (fs::is_directory(path, error)) {
        readFolder(browser, path.string());
        browser.name.clear();
        return {};
    }
    if (browser.purpose == FileBrowser::Purpose::SaveAs) {
        if (path.extension() != ".limn")
            path += ".limn";
        if (fs::exists(path, error) && !browser.overwrite) {
            browser.overwrite = true;
            browser.error = "The file exists. Press Save again to replace it";
            return {};
        }
        return Request{Request::Kind::Save, path.string()};
    }
    if (browser.purpose == FileBrowser::Purpose::SavePictures)
        return picturesRequest(browser, path);
    if (browser.purpose == FileBrowser::Purpose::ExportTo)
        return Request{Request::Kind::Export, path.string()};
    if (!fs::exists(path, error)) {
        browser.error = "There is no " + path.string();
        return {};
    }
    if (browser.purpose == FileBrowser::Purpose::SkyImage)
        return Request{Request::Kind::OpenSkyImage, path.string()};
    if (browser.purpose == FileBrowser::Purpose::LightProfile) {
        Request request{Request::Kind::OpenProfile, path.string()};
        request.object = browser.object;
        return request;
    }
    if (browser.purpose == FileBrowser::Purpose::AddScene ||
        browser.purpose == FileBrowser::Purpose::Texture) {
        Request request{Request::Kind::AddFile, path.string()};
        request.object = browser.object;
        request.slot = browser.slot;
        return request;
    }
    const bool fresh = browser.purpose == FileBrowser::Purpose::NewFromScene;
    return Request{fresh ? Request::Kind::NewFromScene : Request::Kind::Open, path.string()};
}

void fileBrowserDialog(EditorState& state) {
    if (!state.fileBrowser)
        return;
    FileBrowser& browser = *state.fileBrowser;
    const std::string id = std::string(title(browser.purpose)) + "###file browser";
    if (!ImGui::IsPopupOpen("###file browser"))
        ImGui::OpenPopup("###file browser");
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize(
        {std::min(640 * uiScale(), display.x * 0.9f), std::min(480 * uiScale(), display.y * 0.9f)});
    if (!ImGui::BeginPopupModal(id.c_str(), nullptr,
                                ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove))
        return;
    pathRow(browser);
    bool accept = entryList(browser);
    ImGui::SetNextItemWidth(-FLT_MIN);
    accept |= ImGui::InputTextWithHint("##name", "File name", &browser.name,
                                       ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::PushStyleColor(ImGuiCol_Text, color::warning());
    elidedText(browser.error.empty() ? " " : browser.error, ImGui::GetContentRegionAvail().x);
    ImGui::PopStyleColor();
    accept |= ImGui::Button(acceptLabel(browser.purpose));
    ImGui::SameLine();
    const bool cancel = ImGui::Button("Cancel") || ImGui::IsKeyPressed(key::kEscape);
    const auto request = accept ? accepted(browser) : std::nullopt;
    if (request || cancel)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (request && browser.purpose == FileBrowser::Purpose::ExportTo)
        setExportPath(*state.exportDialog, request->path); // the dialog goes on
    else if (request)
        state.requests.push_back(*request);
    if (cancel)
        state.afterSave.reset();
    if (request || cancel)
        state.fileBrowser.reset();
}

} // namespace limn
