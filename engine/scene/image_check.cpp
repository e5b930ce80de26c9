// SPDX-License-Identifier: MIT
#include "engine/scene/image_check.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <numeric>

namespace limn {

namespace {

constexpr std::uint8_t kTables = 0xc4, kScan = 0xda;

/// By class, 0 of DC and 1 of AC, times 16 plus number.
using Tables = std::bitset<256>;

/// The tables of the segment whose length lies at the front of `segment`, as far as they go; adds
/// them to those that are defined.
bool tablesFit(std::span<const std::uint8_t> segment, Tables& defined) {
    constexpr std::size_t kCounts = 16, kMostCodes = 256;
    if (segment.size() < 2)
        return true;
    std::ptrdiff_t left = (segment[0] << 8 | segment[1]) - 2;
    segment = segment.subspan(2);
    while (left > 0 && segment.size() > 1) {
        // Past the end stb reads zeros.
        const auto counts = segment.subspan(1, std::min(kCounts, segment.size() - 1));
        const auto codes = std::accumulate(counts.begin(), counts.end(), std::size_t(0));
        if (codes > kMostCodes)
            return false;
        defined.set(segment[0]);
        const std::size_t table = std::min(1 + kCounts + codes, segment.size());
        segment = segment.subspan(table);
        left -= std::ptrdiff_t(table);
    }
    return true;
}

/// Whether the tables that a scan decodes its components by are among those.
bool scanIsDefined(std::span<const std::uint8_t> segment, const Tables& defined) {
    constexpr std::size_t kComponents = 3; // after the length and their number: name, tables
    const std::size_t count = segment.size() > 2 ? segment[2] : 0, band = kComponents + 2 * count;
    if (segment.size() < band + 2)
        return true; // stb reads zeros there, and refuses it
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t tables = segment[kComponents + 2 * k + 1];
        const bool dc = segment[band] == 0, ac = segment[band + 1] > 0;
        if ((dc && !defined[tables >> 4]) || (ac && !defined[16 + (tables & 15)]))
            return false;
    }
    return true;
}

} // namespace

bool jpegTablesFit(std::span<const std::uint8_t> file) {
    bool inScans = false;
    Tables defined;
    for (std::size_t at = 2; at + 1 < file.size();) { // the first two say that it is a JPEG
        if (file[at] != 0xff || file[at + 1] == 0xff) {
            ++at;
            continue;
        }
        const std::uint8_t marker = file[at + 1];
        at += 2;
        const std::span<const std::uint8_t> segment = file.subspan(at);
        if (marker == kTables && !tablesFit(segment, defined))
            return false;
        if (marker == kScan && !scanIsDefined(segment, defined))
            return false;
        inScans = inScans || marker == kScan;
        // Where coded texels end is for the decoder to say: from there on whatever looks like a
        // marker is one.
        if (!inScans && segment.size() >= 2)
            at += std::min(segment.size(), std::size_t(segment[0] << 8 | segment[1]));
    }
    return true;
}

bool pngChunksFit(std::span<const std::uint8_t> file) {
    constexpr std::size_t kSignature = 8, kAround = 12; // length and name before, checksum behind
    constexpr std::array<std::uint8_t, 4> kEnd = {'I', 'E', 'N', 'D'};
    for (auto rest = file.subspan(std::min(kSignature, file.size())); rest.size() >= 8;) {
        const std::size_t length =
            std::size_t(rest[0]) << 24 | rest[1] << 16 | rest[2] << 8 | rest[3];
        if (std::ranges::equal(rest.subspan(4, 4), kEnd))
            return true;
        if (rest.size() < kAround || length > rest.size() - kAround)
            return false;
        rest = rest.subspan(kAround + length);
    }
    return true; // what is missing is missed by who reads it
}

} // namespace limn
