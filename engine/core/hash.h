// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace limn {

/// 64-bit XXH3 of bytes, chained: hashBytes(b, hashBytes(a)) depends on both and on their order.
std::uint64_t hashBytes(const void* data, std::size_t size, std::uint64_t seed = 0);

template <class T>
requires std::has_unique_object_representations_v<T> || std::is_floating_point_v<T> std::uint64_t
hashValue(const T& value, std::uint64_t seed) {
    return hashBytes(&value, sizeof value, seed);
}

/// Hash of the elements' bytes and their count; T must have no padding.
template <class T>
std::uint64_t hashVector(const std::vector<T>& v, std::uint64_t seed) {
    static_assert(std::is_trivially_copyable_v<T>);
    return hashBytes(v.data(), v.size() * sizeof(T), hashValue(std::uint64_t(v.size()), seed));
}

/// The hash as 16 lower-case hexadecimal digits.
std::string hexHash(std::uint64_t hash);

} // namespace limn
