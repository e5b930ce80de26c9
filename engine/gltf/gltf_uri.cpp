// SPDX-License-Identifier: MIT
#include "engine/gltf/gltf_uri.h"

#include <charconv>
#include <filesystem>

#include <fmt/format.h>

namespace limn {

namespace fs = std::filesystem;

namespace {

std::string decoded(std::string_view uri) {
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned value = 0;
        const char* const digits = uri.data() + i + 1;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
            out += char(value);
            i += 2;
        } else {
            out += uri[i];
        }
    }
    return out;
}

} // namespace

Result<std::string> fileOfUri(const std::string& folder, std::string_view uri, FileReach reach) {
    if (const std::size_t end = uri.find("://"); end != std::string_view::npos)
        return fail(fmt::format("{} is not supported", uri.substr(0, end + 1)));
    const std::string name = decoded(uri);
    if (name.empty() || name.find('\0') != std::string::npos)
        return fail("names no file");
    const fs::path path(name), plain = path.lexically_normal();
    if (reach == FileReach::Folder && (path.is_absolute() || *plain.begin() == ".."))
        return fail("lies outside the scene's folder, which --outside-files allows");
    return (fs::path(folder) / path).string();
}

} // namespace limn
