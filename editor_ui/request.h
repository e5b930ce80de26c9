// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/document/material_edit.h"

#include <string>

namespace limn {

/// Something a panel or an action wants done outside the UI: files, jobs, the window.
struct Request {
    enum class Kind {
        NewFromScene,
        Open,
        OpenSkyImage,
        ExtractSun,  ///< out of the sky's panorama, which makes it a light
        OpenProfile, ///< a photometric file, for the light `object`
        AddFile,     ///< a glTF below a group, a shape at `place`, or a texture of `object`
        Save,
        Bake,
        BakeToError,   ///< EditorState::goals.maxError
        FitToBudget,   ///< EditorState::goals.budgetMs and goals.budgetMiB
        BakeSelection, ///< EditorState::selection alone gets all of its texels
        CancelBake,
        Lint, ///< checks the scene
        CancelLint,
        Export,
        SavePictures, ///< the viewport's and the reference's
        CancelExport,
        Recover,
        DiscardRecovery,
        PostponeRecovery,
        Screenshot,
        Quit
    } kind;
    /// Of NewFromScene, Open, OpenSkyImage, OpenProfile, AddFile (AssetFile::path), Save, Export,
    /// SavePictures.
    std::string path;
    bool discardsChanges = false;              ///< unsaved changes are lost without asking
    Transform place = {};                      ///< of a shape, to world space
    ObjectId object = 0;                       ///< the material or light that gets the file; else 0
    TextureSlot slot = TextureSlot::BaseColor; ///< which texture
};

} // namespace limn
