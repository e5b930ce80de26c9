// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/recent_files.h"

#include "engine/core/log.h"
#include "engine/core/read_file.h"
#include "engine/core/replace_file.h"
#include "engine/core/user_folder.h"

#include <filesystem>
#include <sstream>

namespace limn {

namespace fs = std::filesystem;

/// Empty where the user has no folder for settings.
static fs::path recentPath() {
    const std::string config = userFolder(UserFolder::Config);
    return config.empty() ? fs::path() : fs::path(config) / "recent";
}

std::vector<std::string> readRecentFiles() {
    std::vector<std::string> recent;
    std::istringstream in(readFile(recentPath().string()).value_or(""));
    for (std::string line; recent.size() < 10 && std::getline(in, line);)
        if (!line.empty())
            recent.push_back(line);
    return recent;
}

std::vector<std::string> addRecentFile(std::vector<std::string> recent, const std::string& path) {
    if (path.empty())
        return recent;
    std::error_code error;
    const std::string full = fs::absolute(path, error).string();
    std::erase(recent, full);
    recent.insert(recent.begin(), full);
    if (recent.size() > 10)
        recent.resize(10);
    if (const fs::path file = recentPath(); !file.empty()) {
        fs::create_directories(file.parent_path(), error);
        std::string lines;
        for (const std::string& line : recent)
            lines += line + '\n';
        if (const Result<void> written = replaceFile(file.string(), lines); !written)
            logWarning(written.error().message);
    }
    return recent;
}

} // namespace limn
