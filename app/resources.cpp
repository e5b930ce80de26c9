// SPDX-License-Identifier: MIT
#include "app/resources.h"

#include <filesystem>
#include <system_error>

#include <generated/build_facts.h>

namespace limn {

/// The folder beside an installed program, else the one in the source tree.
static std::string folderOf(const std::string& installedName, const std::string& sourceName) {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!error) {
        const fs::path installed =
            program.parent_path().parent_path() / "share" / "limn" / installedName;
        if (fs::is_directory(installed, error))
            return installed.string();
    }
    return std::string(kSourceFolder) + "/" + sourceName;
}

std::string dataFolder(const std::string& name) {
    return folderOf(name, name);
}

ExportFolders exportFolders() {
    const std::string web = folderOf("web", "build/web"), local = "node_modules/three";
    std::error_code error;
    const bool here = std::filesystem::is_directory(local, error);
    return {.three = here ? local : web + "/" + local, .webRuntime = web};
}

} // namespace limn
