// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <string>

namespace limn {

/// Files for the viewport's picture and its reference, in this order, when `path` was chosen:
/// NAME-limn.exr and NAME-reference.exr for NAME.exr.
inline std::array<std::string, 2> pictureFiles(const std::filesystem::path& path) {
    const std::string stem = std::filesystem::path(path).replace_extension().string();
    return {stem + "-limn.exr", stem + "-reference.exr"};
}

} // namespace limn
