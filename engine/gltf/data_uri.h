// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <string>
#include <string_view>

namespace limn {

bool isDataUri(std::string_view uri);

/// Bytes that a data URI holds, whatever its media type and parameters (RFC 2397). Fails on what is
/// not base64 where it says so.
Result<std::string> dataOfUri(std::string_view uri);

/// Replaces %XX by the byte that it stands for.
std::string percentDecoded(std::string_view text);

} // namespace limn
