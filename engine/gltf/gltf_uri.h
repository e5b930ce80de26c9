// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <string>
#include <string_view>

namespace limn {

/// Which files a scene may name.
enum class FileReach { Folder, Anywhere };

/// The path of the file that a relative reference (RFC 3986) of a glTF in `folder` means. Percent
/// escapes are decoded once; '+' is a plus. Fails on schemes, and, unless it may reach anywhere, on
/// absolute paths and on those that leave the folder by "..": a scene from the network has no
/// business elsewhere. Symbolic links in the folder are the user's own and may lead out of it.
Result<std::string> fileOfUri(const std::string& folder, std::string_view uri, FileReach reach);

} // namespace limn
