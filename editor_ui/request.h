// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace limn {

/// Something a panel or an action wants done outside the UI: files, jobs, the window.
struct Request {
    enum class Kind {
        NewFromScene,
        Open,
        OpenSkyImage,
        Save,
        Bake,
        BakeToError, ///< EditorState::bakeError
        CancelBake,
        Export,
        CancelExport,
        Recover,
        DiscardRecovery,
        PostponeRecovery,
        Screenshot,
        Quit
    } kind;
    std::string path;             ///< of NewFromScene, Open, OpenSkyImage, Save, Export
    bool discardsChanges = false; ///< unsaved changes are lost without asking
};

} // namespace limn
