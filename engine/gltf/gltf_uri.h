// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <string>
#include <string_view>

namespace limn {

/// Which files a scene may refer to.
enum class FileReach { Folder, Anywhere };

/// Path of the file that a relative reference (RFC 3986) in a glTF in `folder` refers to. Percent
/// escapes are decoded once; '+' is a plus. Fails on schemes, and, unless `reach` is Anywhere, on
/// absolute paths and on paths that leave the folder by "..", because a scene from the network must
/// not access other files. Symbolic links in the folder are the user's own and may lead out of it.
Result<std::string> fileOfUri(const std::string& folder, std::string_view uri, FileReach reach);

} // namespace limn
