// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace limn {

/// Checks that a file can be written at `path`, before the work whose result goes there. Its folder
/// must exist and be writable, its name must end in one of `extensions`, and it must be none of
/// `inputs` under any name or link. An existing file must be a regular file that is empty or of the
/// format that its extension names. Writes nothing.
Result<void> checkOutputFile(const std::string& path, std::span<const std::string_view> extensions,
                             std::initializer_list<std::string> inputs = {});
inline Result<void> checkOutputFile(const std::string& path,
                                    std::initializer_list<std::string_view> extensions,
                                    std::initializer_list<std::string> inputs = {}) {
    return checkOutputFile(path, std::span(extensions.begin(), extensions.size()), inputs);
}

} // namespace limn
