// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace limn {

/// Appends the four bytes of a word, the lowest first.
inline void appendWord(std::string& out, std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8)
        out += char(word >> shift);
}

} // namespace limn
