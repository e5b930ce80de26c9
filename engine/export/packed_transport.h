// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <string>
#include <string_view>

namespace limn {

/// Bytes as a gzip stream (RFC 1952), which browsers expand by DecompressionStream. Fails without
/// memory.
Result<std::string> gzip(std::string_view bytes);

/// A transport file as docs/transport-format.md has it packed: the bytes of its numbers sorted by
/// their weight, so that they compress well, as a gzip stream. Precondition: TransportSections
/// wrote the file.
Result<std::string> packTransport(std::string_view file);

} // namespace limn
