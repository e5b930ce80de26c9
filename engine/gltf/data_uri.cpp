// SPDX-License-Identifier: MIT
#include "engine/gltf/data_uri.h"

#include "engine/core/base64.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace limn {

static std::string lowerCase(std::string_view text) {
    std::string out(text);
    std::ranges::transform(out, out.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return out;
}

bool isDataUri(std::string_view uri) {
    return lowerCase(uri.substr(0, 5)) == "data:";
}

std::string percentDecoded(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        const char* const digits = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() &&
            std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
            out += char(value);
            i += 2;
        } else {
            out += text[i];
        }
    }
    return out;
}

Result<std::string> dataOfUri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (!isDataUri(uri) || comma == std::string_view::npos)
        return fail("is no data URI");
    const std::string data = percentDecoded(uri.substr(comma + 1));
    return lowerCase(uri.substr(0, comma)).ends_with(";base64") ? fromBase64(data)
                                                                : Result<std::string>(data);
}

} // namespace limn
