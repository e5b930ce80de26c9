// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/export_format.h"
#include "engine/gltf/gltf_import.h"

#include <functional>
#include <string>

namespace limn {

struct SessionOptions {
    std::string projectsFolder;
    std::function<void()> wake; ///< called from any thread when there is something new for update()
    bool bakeOnOpen = true;     ///< a scene without a bake is baked as soon as it is open
    std::string bakeFolder;     ///< for finished stages of bakes; empty: they are kept in memory
    ImportOptions
        import; ///< for every scene that is opened; its memory limit is also that of bakes
    ExportFolders exportFolders = {};
    std::string recoveryFolder = {}; ///< for copies of unsaved documents; empty: none are kept
    std::string settingsFile =
        {}; ///< of the window, read at the start, written soon after they change; or empty
};

} // namespace limn
