// SPDX-License-Identifier: MIT
#include "engine/core/user_folder.h"

#include "engine/core/read_file.h"

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string_view>

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

/// The value of XDG_DOCUMENTS_DIR="..." in the file that xdg-user-dirs writes, which is absolute or
/// begins with $HOME. Empty where there is none.
static fs::path configuredDocuments(const fs::path& home) {
    fs::path config = pathIn("XDG_CONFIG_HOME");
    if (config.empty())
        config = home / ".config";
    std::istringstream lines(readFile((config / "user-dirs.dirs").string(), 1 << 16).value_or(""));
    constexpr std::string_view kName = "XDG_DOCUMENTS_DIR=\"", kHome = "$HOME/";
    for (std::string line; std::getline(lines, line);) {
        const std::size_t end = line.rfind('"');
        if (!line.starts_with(kName) || end < kName.size())
            continue;
        const std::string value = line.substr(kName.size(), end - kName.size());
        const fs::path path =
            value.starts_with(kHome) ? home / value.substr(kHome.size()) : fs::path(value);
        return path.is_absolute() ? path : fs::path();
    }
    return {};
}

std::string documentsFolder() {
    const fs::path home = pathIn("HOME");
    std::error_code error;
    if (!home.empty())
        for (const fs::path& folder : {configuredDocuments(home), home / "Documents"})
            if (fs::is_directory(folder, error))
                return folder.string();
    return home.string();
}

} // namespace limn
