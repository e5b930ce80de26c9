// SPDX-License-Identifier: MIT
#include "engine/core/base64.h"

#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>

namespace limn {

static constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string base64(std::string_view bytes) {
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t begin = 0; begin < bytes.size(); begin += 3) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8 |
                   (begin + k < bytes.size() ? static_cast<unsigned char>(bytes[begin + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            out += begin + k > bytes.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63];
    }
    return out;
}

Result<std::string> fromBase64(std::string_view text) {
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

} // namespace limn
