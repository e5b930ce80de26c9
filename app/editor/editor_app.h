// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/export/export_format.h"
#include "engine/files/relight_choice.h"
#include "engine/gltf/gltf_import.h"

#include <cstdint>
#include <string>

namespace limn {

struct EditorAppOptions {
    std::string scene = "cornell";
    std::string projectsFolder;
    ExportFolders exportFolders;
    ImportOptions import;
    std::uint32_t width = 1440, height = 900;
    std::string statsPath; ///< empty: none
    bool validate = false;
    bool noBake = false;
    RelightOn relightOn = RelightOn::Auto;
};

/// Opens the window and runs until the user quits. Fails without a display or a Vulkan driver, and,
/// with `validate`, if the validation layer reported anything.
Result<void> runEditor(const EditorAppOptions& options);

} // namespace limn
