// SPDX-License-Identifier: MIT
#include "app/output_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

namespace limn {

namespace fs = std::filesystem;

Result<void> checkOutputFile(const std::string& path,
                             std::initializer_list<const char*> extensions) {
    const fs::path file(path);
    std::error_code error;
    if (fs::is_directory(file, error))
        return fail(fmt::format("{}: is a folder", path));
    if (extensions.size() > 0 &&
        std::ranges::find(extensions, file.extension().string()) == extensions.end())
        return fail(fmt::format("{}: must end in {}", path, fmt::join(extensions, " or ")));
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error))
        return fail(fmt::format("{}: there is no folder {}", path, folder.string()));
    if (access(fs::exists(file, error) ? path.c_str() : folder.c_str(), W_OK) != 0)
        return fail(fmt::format("{}: cannot write: {}", path, std::strerror(errno)));
    return {};
}

} // namespace limn
