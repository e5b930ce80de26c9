// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <malloc.h>

namespace limn {

/// Memory that the program has allocated and not freed [bytes]. Precondition: all threads share
/// one arena (mallopt(M_ARENA_MAX, 1)), since this counts the main one.
inline std::size_t heapInUse() {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

} // namespace limn
