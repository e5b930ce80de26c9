// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/document/material_edit.h"

#include <string>
#include <vector>

namespace limn {

struct EditorState;

/// The dialog's state. `entries` is read from disk when `folder` changes, not each frame.
struct FileBrowser {
    enum class Purpose {
        NewFromScene,
        Open,
        SaveAs,
        SkyImage,
        LightProfile,
        ExportTo,
        AddScene,
        Texture,
        SavePictures
    } purpose = Purpose::Open;
    struct Entry {
        std::string name;
        bool isFolder = false;
    };
    std::string folder; ///< absolute
    std::string name;   ///< chosen or typed file name
    std::vector<Entry> entries;
    std::string error;      ///< why the folder could not be read or the name was refused
    bool overwrite = false; ///< the user was warned that the file exists
    ObjectId object = 0;    ///< the material or light that gets the file
    TextureSlot slot = TextureSlot::BaseColor;
};

/// Opens the dialog at the folder of the sky's image (to choose one), of the current project or
/// scene, or the working directory. Samples are saved in the user's documents.
void openFileBrowser(EditorState& state, FileBrowser::Purpose purpose);

/// The same, to choose a texture of a material.
void openTextureBrowser(EditorState& state, ObjectId material, TextureSlot slot);

/// The same, to choose a photometric file for a light.
void openProfileBrowser(EditorState& state, ObjectId light);

/// Reads `folder`: folders first, then files with an extension that fits the purpose, each by name.
void readFolder(FileBrowser& browser, const std::string& folder);

/// Draws the dialog while it is open; puts a Request when the user is done.
void fileBrowserDialog(EditorState& state);

} // namespace limn
