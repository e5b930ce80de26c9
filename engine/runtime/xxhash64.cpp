// SPDX-License-Identifier: MIT
#include "engine/runtime/xxhash64.h"

#include <cstring>

namespace limn::runtime {

namespace {

constexpr std::uint64_t kPrime1 = 0x9E3779B185EBCA87, kPrime2 = 0xC2B2AE3D27D4EB4F,
                        kPrime3 = 0x165667B19E3779F9, kPrime4 = 0x85EBCA77C2B2AE63,
                        kPrime5 = 0x27D4EB2F165667C5;

std::uint64_t rotated(std::uint64_t v, int bits) {
    return v << bits | v >> (64 - bits);
}
template <class T>
T read(const unsigned char* p) {
    T v;
    std::memcpy(&v, p, sizeof v);
    return v;
}
std::uint64_t mixed(std::uint64_t lane, std::uint64_t input) {
    return rotated(lane + input * kPrime2, 31) * kPrime1;
}

/// The 32-byte blocks. `p` ends behind the last one.
std::uint64_t blocks(const unsigned char*& p, const unsigned char* end) {
    std::uint64_t lane[4] = {kPrime1 + kPrime2, kPrime2, 0, 0 - kPrime1};
    for (; end - p >= 32; p += 32)
        for (int i = 0; i < 4; ++i)
            lane[i] = mixed(lane[i], read<std::uint64_t>(p + 8 * i));
    std::uint64_t h =
        rotated(lane[0], 1) + rotated(lane[1], 7) + rotated(lane[2], 12) + rotated(lane[3], 18);
    for (const std::uint64_t l : lane)
        h = (h ^ mixed(0, l)) * kPrime1 + kPrime4;
    return h;
}

} // namespace

std::uint64_t xxhash64(const void* bytes, std::size_t size) {
    const auto* p = static_cast<const unsigned char*>(bytes);
    const unsigned char* const end = p + size;
    std::uint64_t h = (size >= 32 ? blocks(p, end) : kPrime5) + size;
    for (; end - p >= 8; p += 8)
        h = rotated(h ^ mixed(0, read<std::uint64_t>(p)), 27) * kPrime1 + kPrime4;
    if (end - p >= 4) {
        h = rotated(h ^ read<std::uint32_t>(p) * kPrime1, 23) * kPrime2 + kPrime3;
        p += 4;
    }
    for (; p != end; ++p)
        h = rotated(h ^ *p * kPrime5, 11) * kPrime1;
    h = (h ^ h >> 33) * kPrime2;
    h = (h ^ h >> 29) * kPrime3;
    return h ^ h >> 32;
}

} // namespace limn::runtime
