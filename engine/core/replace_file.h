// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace limn {

/// What becomes of a symbolic link at the path that is written.
enum class AtLink : std::uint8_t {
    Follow, ///< the file that it points to is replaced
    Replace ///< the link itself is
};

/// Writes `bytes` to a file without a name, syncs it and gives it the name `path`: either the old
/// file or the new one is there, whenever the program or the machine stops, and nothing else. Where
/// an old file is exchanged, the new one is called temporaryName(path) for a moment; a program
/// killed just then leaves it behind, and the next call removes it. File systems that know no files
/// without names may keep a temporary one of a killed program. A new file gets the permissions of
/// the old one. On failure the old one is as it was; what is neither a file nor a link is never
/// replaced.
Result<void> replaceFile(const std::string& path, std::string_view bytes,
                         AtLink link = AtLink::Follow);

/// ".limn-HASH.tmp" in the same folder; the hash is that of the file's name.
std::string temporaryName(const std::string& path);

} // namespace limn
