// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace limn {

/// A path as a URI reference (RFC 3986, 2005): all bytes but unreserved characters and slashes are
/// percent-encoded, so that a colon is no scheme.
std::string percentEncoded(std::string_view path);

} // namespace limn
