// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace limn {

/// What happens to a symbolic link at the written path.
enum class AtLink : std::uint8_t {
    Follow, ///< the file that it points to is replaced
    Replace ///< the link itself is replaced
};

/// Replaces a file atomically: writes `bytes` to an unnamed file, syncs it and gives it the name
/// `path`, so that either the old file or the new one exists, whenever the program or the machine
/// stops. If an old file is replaced, the new one is briefly called temporaryName(path); a program
/// killed at that moment leaves it behind, and the next call removes it. On file systems without
/// unnamed files a killed program may leave a temporary file. A new file gets the permissions of
/// the old one. On failure the old file is unchanged. Anything that is neither a file nor a link is
/// never replaced.
Result<void> replaceFile(const std::string& path, std::string_view bytes,
                         AtLink link = AtLink::Follow);

/// Returns ".limn-HASH.tmp" in the same folder, with a hash of the file's name.
std::string temporaryName(const std::string& path);

} // namespace limn
