// SPDX-License-Identifier: MIT
#include "app/resources.h"

#include <filesystem>
#include <system_error>

namespace limn {

std::string dataFolder(const std::string& name) {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!error) {
        const fs::path installed = program.parent_path().parent_path() / "share" / "limn" / name;
        if (fs::is_directory(installed, error))
            return installed.string();
    }
    return std::string(LIMN_SOURCE_DIR "/") + name;
}

} // namespace limn
