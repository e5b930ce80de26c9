// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <string>
#include <string_view>

namespace limn {

/// Bytes as text, by RFC 4648, section 4.
std::string base64(std::string_view bytes);

/// The bytes again. White space may stand anywhere, and padding may be absent. Fails on all else
/// that is not base64, with "is not base64".
Result<std::string> fromBase64(std::string_view text);

} // namespace limn
