// SPDX-License-Identifier: MIT
#include "engine/core/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

namespace limn {

std::uint64_t hashBytes(const void* data, std::size_t size, std::uint64_t seed) {
    return XXH3_64bits_withSeed(data, size, seed);
}

std::string hexHash(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

} // namespace limn
