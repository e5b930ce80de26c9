// SPDX-License-Identifier: MIT
// Files that a document refers to: panoramas, photometric files, scenes, shapes and textures.
#include "editor_ui/document/added_file.h"
#include "editor_ui/document/document_edit.h"
#include "editor_ui/session.h"
#include "engine/scene/find_object.h"

namespace limn {

void Session::setPicture(std::shared_ptr<const LinearPicture> picture) {
    m_picture = std::move(picture);
}

void Session::takeSky() {
    auto read = m_files.takeSky();
    if (!read)
        return;
    state.loading.clear();
    if (!*read) {
        complain("Not opened as the sky", read->error().message);
        return;
    }
    log(LogLine::Level::Info, "Opened " + (*read)->image);
    setSkyImage(state, **read);
}

void Session::openProfile(const std::string& path, ObjectId light) {
    if (!findObjectAs<Light>(state.document, light)) {
        complain("Not opened", path + ": select the light that gets this profile first");
    } else if (m_files.openProfile(path)) {
        state.loading = path;
        m_adding = {.kind = Request::Kind::OpenProfile, .path = path, .object = light};
    } else {
        complain("Not opened", path + ": another file is being opened or saved; try again");
    }
}

void Session::takeProfile() {
    auto read = m_files.takeProfile();
    if (!read)
        return;
    if (!*read) {
        complain("Not opened as an IES profile", read->error().message);
    } else {
        log(LogLine::Level::Info, "Opened " + state.loading);
        if ((*read)->resampled)
            log(LogLine::Level::Warning,
                state.loading + ": its angles lie closer than a profile's and were interpolated");
        setLightProfile(state, m_adding.object, (*read)->profile);
    }
    state.loading.clear();
}

/// Edits the document by a request whose file is in the assets.
static void useFile(EditorState& state, const Request& request, const AssetFile& file,
                    const ImportedScene& imported) {
    if (request.object)
        setTexture(state, request.object, request.slot, std::int32_t(file.firstImage));
    else if (isSceneFile(request.path))
        addScene(state, file, imported);
    else
        addShape(state, file, request.place);
}

void Session::addFile(const Request& request) {
    // A shape does not change; a file may have.
    const AssetFile* known = findAssetFile(state.document, request.path);
    if (known && shapeOfPath(request.path)) {
        useFile(state, request, AssetFile(*known), {});
    } else if (m_files.add(state.assets, request.path)) {
        m_adding = request;
        state.loading = request.path;
    } else {
        complain("Not added", request.path + ": another file is being opened or saved; try again");
    }
}

void Session::takeAdded() {
    auto read = m_files.takeAdded();
    if (!read)
        return;
    state.loading.clear();
    if (!*read) {
        complain("Not added", read->error().message);
        return;
    }
    AddedAssets& added = (*read)->added;
    takeAssets(state, added, std::move((*read)->meshBounds));
    for (const std::string& repair : added.imported.repairs)
        log(LogLine::Level::Warning, repair);
    if (!shapeOfPath(m_adding.path))
        log(LogLine::Level::Info, "Added " + m_adding.path);
    useFile(state, m_adding, added.file, added.imported);
}

} // namespace limn
