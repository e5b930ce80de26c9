// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_uri.h"

#include "engine/gltf/data_uri.h"

#include <filesystem>

#include <fmt/format.h>

namespace limn {

namespace fs = std::filesystem;

Result<std::string> fileOfUri(const std::string& folder, std::string_view uri, FileReach reach) {
    if (const std::size_t end = uri.find("://"); end != std::string_view::npos)
        return fail(fmt::format("{} is not supported", uri.substr(0, end + 1)));
    const std::string name = percentDecoded(uri);
    if (name.empty() || name.find('\0') != std::string::npos)
        return fail("names no file");
    const fs::path path(name), plain = path.lexically_normal();
    if (reach == FileReach::Folder && (path.is_absolute() || *plain.begin() == ".."))
        return fail("lies outside the scene's folder, which --outside-files allows");
    return (fs::path(folder) / path).string();
}

} // namespace limn
