// SPDX-License-Identifier: MIT
#include "engine/core/user_folder.h"

#include <cstdlib>
#include <filesystem>

namespace limn {

namespace fs = std::filesystem;

/// The absolute path in an environment variable; empty where there is none.
static fs::path pathIn(const char* variable) {
    const char* value = std::getenv(variable);
    const fs::path path = value ? value : "";
    return path.is_absolute() ? path : fs::path();
}

static std::string folderIn(const char* variable, const char* belowHome) {
    if (const fs::path folder = pathIn(variable); !folder.empty())
        return (folder / "limn").string();
    if (const fs::path home = pathIn("HOME"); !home.empty())
        return (home / belowHome / "limn").string();
    return {};
}

std::string userFolder(UserFolder kind) {
    switch (kind) {
    case UserFolder::Config:
        return folderIn("XDG_CONFIG_HOME", ".config");
    case UserFolder::Cache:
        return folderIn("XDG_CACHE_HOME", ".cache");
    case UserFolder::State:
        return folderIn("XDG_STATE_HOME", ".local/state");
    }
    return {};
}

} // namespace limn
