// SPDX-License-Identifier: MIT
#include "engine/core/base64.h"

#include <cstddef>
#include <cstdint>

namespace limn {

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
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

} // namespace limn
