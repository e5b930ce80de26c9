// SPDX-License-Identifier: MIT
#include "engine/core/percent_encoding.h"

#include <fmt/format.h>

namespace limn {

std::string percentEncoded(std::string_view path) {
    constexpr std::string_view kPlain = "-._~/";
    std::string uri;
    for (const char c : path) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (letter || (c >= '0' && c <= '9') || kPlain.find(c) != std::string_view::npos)
            uri += c;
        else
            uri += fmt::format("%{:02X}", unsigned(static_cast<unsigned char>(c)));
    }
    return uri;
}

} // namespace limn
