// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace limn {

/// Asks for pages of 2 MiB, where the system has any, for the part of [begin, begin + bytes) that
/// fills such pages. A hint: it may have no effect.
void preferLargePages(void* begin, std::size_t bytes);

/// Reserves room in an array of many MiB. Each page costs a fault when it is first written to,
/// which takes longer than to fill 4 KiB: without large pages, filling 37 MiB took 0.2 s.
template <class T>
void reserveLarge(std::vector<T>& array, std::size_t size) {
    array.reserve(size);
    preferLargePages(array.data(), size * sizeof(T));
}

/// The same, and resizes it.
template <class T>
void resizeLarge(std::vector<T>& array, std::size_t size) {
    reserveLarge(array, size);
    array.resize(size);
}

} // namespace limn
