// SPDX-License-Identifier: MIT
#include "engine/gltf/data_uri.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>

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

static Result<std::string> base64Decoded(std::string_view text) {
    static constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<std::uint8_t, 256> value;
    value.fill(64);
    for (std::size_t i = 0; i < kDigits.size(); ++i)
        value[std::uint8_t(kDigits[i])] = std::uint8_t(i);
    std::string out;
    out.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0, count = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        if (std::isspace(c))
            continue;
        if (c == '=') // padding, which nothing but padding follows
            return text.find_first_not_of("= \t\r\n", i) == std::string_view::npos
                       ? Result<std::string>(out)
                       : fail("is not base64");
        if (value[c] == 64)
            return fail("is not base64");
        bits = bits << 6 | value[c];
        if (++count % 4 != 1)
            out += char(bits >> (6 - 2 * ((count - 1) % 4)) & 255U);
    }
    return out;
}

Result<std::string> dataOfUri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (!isDataUri(uri) || comma == std::string_view::npos)
        return fail("is no data URI");
    const std::string data = percentDecoded(uri.substr(comma + 1));
    return lowerCase(uri.substr(0, comma)).ends_with(";base64") ? base64Decoded(data)
                                                                : Result<std::string>(data);
}

} // namespace limn
