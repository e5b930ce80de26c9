// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <zstd.h>

namespace limn {

/// A KTX2 file of one picture, as its specification has it, and two levels.
inline std::vector<std::uint8_t> ktx2(std::uint32_t format, std::uint32_t width,
                                      std::uint32_t height, const std::string& texels,
                                      std::uint32_t packing = 0) {
    std::string file("\xabKTX 20\xbb\r\n\x1a\n", 12);
    const auto put = [&](auto value) {
        file.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    std::string stored = texels;
    if (packing == 2) {
        stored.resize(ZSTD_compressBound(texels.size()));
        stored.resize(ZSTD_compress(stored.data(), stored.size(), texels.data(), texels.size(), 3));
    }
    for (const std::uint32_t word :
         {format, 1U, width, height, 0U, 0U, 1U, 2U, packing, 0U, 0U, 0U, 0U})
        put(word);
    put(std::uint64_t(0)), put(std::uint64_t(0)); // no global data
    const std::uint64_t begin = file.size() + 48;
    put(begin), put(std::uint64_t(stored.size())), put(std::uint64_t(texels.size()));
    put(begin), put(std::uint64_t(0)), put(std::uint64_t(0)); // the coarser level
    file += stored;
    return {file.begin(), file.end()};
}

} // namespace limn
